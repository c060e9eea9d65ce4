// The timeline: any time, exactly, also of bodies that come later.
#include "elastoon/timeline.h"

#include "test_support.h"

namespace elastoon {
namespace {

TEST(Timeline, GivesThePosesThatTheWorldHad) {
    World world = worldWithFloor();
    BodyDef def;
    def.shape = valueOf(Shape::cylinder(0.25, 1.0));
    def.position = {0.0, 4.0, 0.0};
    def.velocity = {2.0, 1.0, 0.0};
    const BodyId first = valueOf(world.addBody(def));
    Timeline timeline;
    timeline.begin(world);
    std::vector<std::pair<double, Pose>> seen;
    BodyId second;
    for (int i = 0; i < 400; ++i) {
        if (i == 100) {
            second = valueOf(world.addBody(def));
        }
        world.step(1.0 / 60.0);
        timeline.capture(world);
        seen.emplace_back(world.time(), world.pose(first));
    }
    ASSERT_EQ(timeline.tracks().size(), 2U);
    EXPECT_EQ(timeline.tracks()[1].body(), second);
    EXPECT_EQ(timeline.end(), world.time());
    for (auto entry = seen.rbegin(); entry != seen.rend(); ++entry) {
        const Pose pose = timeline.tracks()[0].poseAt(entry->first);
        EXPECT_EQ(pose.position, entry->second.position);
        EXPECT_EQ(pose.orientation, entry->second.orientation);
        EXPECT_EQ(pose.stretch, entry->second.stretch);
    }
    EXPECT_EQ(timeline.tracks()[0].poseAt(-5.0).position, def.position);
    EXPECT_GE(timeline.events().size(), 8U);
}

TEST(Timeline, KeepsUserChanges) {
    World world = worldWith({0, 0, 0});
    BodyDef def;
    def.shape = valueOf(Shape::box(Vec3(1.0)));
    const BodyId body = valueOf(world.addBody(def));
    Timeline timeline;
    timeline.begin(world);
    world.step(1.0);
    timeline.capture(world);
    ASSERT_TRUE(world.setVelocity(body, {1, 0, 0}).ok());
    world.step(1.0);
    timeline.capture(world);
    EXPECT_LT(glm::length(timeline.tracks()[0].poseAt(1.5).position - Vec3(0.5, 0, 0)), 1e-12);
    EXPECT_LT(glm::length(timeline.tracks()[0].poseAt(0.5).position), 1e-12);
}

} // namespace
} // namespace elastoon
