// The step cuts time, and nothing else: scenes with corners, presses, slides and rests come out the same.
#include "elastoon/scene.h"
#include "test_support.h"

#include <cmath>
#include <functional>
#include <string>

namespace elastoon {
namespace {

using Rule = std::function<double(double)>; ///< time -> length of the next step

struct Seen {
    std::vector<Pose> poses; ///< of every body, at every look
    std::vector<bool> rests;
};

/// Looks twice a second.
Seen run(const Scene& scene, const Rule& rule) {
    StagedScene staged = valueOf(stage(scene));
    Seen seen;
    for (int look = 1; look <= static_cast<int>(2.0 * scene.duration); ++look) {
        const double until = 0.5 * look;
        while (staged.world.time() < until - 1e-12) {
            staged.world.step(std::min(rule(staged.world.time()), until - staged.world.time()));
        }
        for (const BodyId body : staged.bodies) {
            seen.poses.push_back(staged.world.pose(body));
            seen.rests.push_back(staged.world.phase(body).is<Rest>());
        }
    }
    return seen;
}

TEST(Step, CornersPressesSlidesAndRestsDoNotDependOnIt) {
    const char* const files[] = {"figures/5-angled-cylinder.json",
                                 "figures/6-left-corner.json",
                                 "figures/6-right-corner.json",
                                 "figures/7-floor-then-wall.json",
                                 "contacts/corner.json",
                                 "contacts/press.json",
                                 "contacts/rest.json",
                                 "contacts/skip.json",
                                 "contacts/slide.json",
                                 "tests/mixed.json"};
    Random random(61);
    const Rule rules[] = {[](double) { return 1.0 / 24.0; }, [](double) { return 1.0 / 30.0; },
                          [](double) { return 1.0 / 144.0; }, [&](double) { return random.uniform(1e-4, 0.2); },
                          [](double) { return 1.0; }};
    int rested = 0;
    for (const std::string file : files) {
        const Scene scene = valueOf(readScene(std::string(ELASTOON_SOURCE_DIR) + "/scenes/" + file));
        const Seen reference = run(scene, [](double) { return 1.0 / 60.0; });
        for (const Rule& rule : rules) {
            const Seen seen = run(scene, rule);
            ASSERT_EQ(seen.poses.size(), reference.poses.size());
            for (std::size_t i = 0; i < seen.poses.size(); ++i) {
                const double length = scene.bodies[i % scene.bodies.size()].def.shape->length();
                EXPECT_LT(glm::length(seen.poses[i].position - reference.poses[i].position), 1e-4 * length)
                    << file << ", look " << i;
                EXPECT_NEAR(seen.poses[i].stretch, reference.poses[i].stretch, 1e-4) << file << ", look " << i;
                EXPECT_LT(angleBetween(seen.poses[i].orientation, reference.poses[i].orientation), 1e-4)
                    << file << ", look " << i;
                EXPECT_EQ(seen.rests[i], reference.rests[i]) << file << ", look " << i;
                rested += seen.rests[i] ? 1 : 0;
            }
        }
    }
    EXPECT_GT(rested, 50);
}

} // namespace
} // namespace elastoon
