// The oracle agrees with good motion, and must not be fooled by bad one.
#include "oracle.h"

#include "test_support.h"

namespace elastoon {
namespace {

constexpr const char* kScene = R"({"elastoon": 1, "duration": 4,
  "shapes": {"can": {"type": "cylinder", "radius": 0.3, "length": 1}},
  "bodies": [{"shape": "can", "position": [0, 3, 0], "velocity": [1, 0, 0]}],
  "obstacles": [{"name": "floor", "type": "plane", "normal": [0, 1, 0], "offset": 0}]})";

struct Played {
    Scene scene;
    StagedScene staged;
    Timeline timeline;
};

/// Plays the scene, with its floor where `offset` says; the oracle is then shown the scene as written.
Played play(double offset) {
    Scene scene = valueOf(parseScene(kScene));
    Scene other = scene;
    other.obstacles[0].def = ObstacleDef::plane({0, 1, 0}, offset);
    Played played{std::move(scene), valueOf(stage(other)), {}};
    played.timeline.begin(played.staged.world);
    for (int i = 0; i < 240; ++i) {
        played.staged.world.step(1.0 / 60.0);
        played.timeline.capture(played.staged.world);
    }
    return played;
}

TEST(Oracle, PassesGoodMotion) {
    const Played played = play(0.0);
    const OracleReport report = inspect(played.scene, played.staged, played.timeline, 240.0);
    EXPECT_TRUE(report.withinBounds());
    EXPECT_LT(report.depth.value, 1e-9);
    EXPECT_LT(report.gap.value, 1e-8);
    EXPECT_LT(report.jump.value, 1e-8);
    EXPECT_GT(report.poses, 1000U);
}

TEST(Oracle, SeesPenetrationAndGaps) {
    const Played sunk = play(-1e-6);
    const OracleReport deep = inspect(sunk.scene, sunk.staged, sunk.timeline, 240.0);
    EXPECT_FALSE(deep.withinBounds());
    EXPECT_NEAR(deep.depth.value, 1e-6, 1e-8);
    EXPECT_EQ(deep.depth.other, "floor");
    const Played lifted = play(1e-3);
    const OracleReport wide = inspect(lifted.scene, lifted.staged, lifted.timeline, 240.0);
    EXPECT_FALSE(wide.withinBounds());
    EXPECT_NEAR(wide.gap.value, 1e-3, 1e-6);
}

} // namespace
} // namespace elastoon
