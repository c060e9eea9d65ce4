// How far and how fast a held body is at most: against its vertices, looked at very often.
#include "held_bounds.h"

#include "impact_support.h"
#include "test_support.h"

#include <algorithm>
#include <cmath>

namespace elastoon {
namespace {

struct Reached {
    int impacts = 0;
    double radius = 0.0, above = 0.0, below = 0.0; ///< largest shares of the drum that are made use of
};

/// Each vertex, at many times, in the drum and within the reach.
void look(const Struck& struck, Reached& reached) {
    const double start = struck.phase.start;
    const double end = struck.phase.end;
    const HeldBounds bounds = heldBounds(struck.phase, *struck.shape, start, end);
    const auto drum = drumAboutContact(struck.phase, bounds.reach, end);
    ASSERT_TRUE(drum);
    constexpr int kLooks = 200;
    for (int k = 0; k <= kLooks; ++k) {
        const Pose pose = poseAt(struck.phase, *struck.shape, start + (end - start) * k / kLooks);
        for (const Vec3& vertex : struck.shape->vertices()) {
            const Vec3 point = worldFromShape(pose, vertex);
            ASSERT_LE(glm::length(point - pose.position), bounds.reach * (1.0 + 1e-12));
            const Vec3 from_foot = point - drum->foot;
            const double height = glm::dot(from_foot, drum->normal);
            const double aside = glm::length(from_foot - drum->normal * height);
            ASSERT_LE(aside, drum->radius);
            ASSERT_LE(height, drum->above);
            ASSERT_GE(height, -drum->below);
            reached.radius = std::max(reached.radius, aside / drum->radius);
            reached.above = std::max(reached.above, height / drum->above);
            reached.below = std::max(reached.below, -height / drum->below);
        }
    }
    ++reached.impacts;
}

TEST(HeldBounds, NoPointLeavesTheDrumOfAnImpactOnAPlane) {
    Random random(31);
    Reached reached;
    for (int i = 0; i < 300 * soak(); ++i) {
        if (const auto struck = randomImpact(random, i)) {
            look(*struck, reached);
        }
    }
    EXPECT_GT(reached.impacts, 150);
    EXPECT_GT(reached.radius, 0.5);
    EXPECT_GT(reached.above, 0.5);
}

TEST(HeldBounds, NoPointLeavesTheDrumOfAnImpactOnAnEdge) {
    Random random(32);
    Reached free, beside;
    for (int i = 0; i < 400 * soak(); ++i) {
        if (const auto struck = randomSteepImpact(random, i)) {
            look(*struck, struck->phase.clear_of.empty() ? free : beside);
        }
    }
    EXPECT_GT(free.impacts, 50);
    EXPECT_GT(beside.impacts, 50);
    EXPECT_GT(free.radius, 0.5);
    EXPECT_GT(free.above, 0.5);
    EXPECT_GT(free.below, 0.1); // some hang over the edge
    EXPECT_GT(beside.radius, 0.1);
}

TEST(HeldBounds, DrumsAreAsWideAsTheirPointsInEveryDirection) {
    Random random(33);
    for (int i = 0; i < 200; ++i) {
        const Drum drum{random.inBox(2.0), random.direction(), random.uniform(0.1, 2.0), random.uniform(0.0, 1.0),
                        random.uniform(0.1, 2.0)};
        const Vec3 direction = random.direction();
        const Vec3 u = glm::normalize(glm::cross(drum.normal, random.direction()));
        const Vec3 v = glm::cross(drum.normal, u);
        double lowest = std::numeric_limits<double>::infinity();
        constexpr int kAround = 360;
        for (int k = 0; k < kAround; ++k) {
            const double angle = 2.0 * 3.141592653589793 * k / kAround;
            const Vec3 rim = drum.radius * (u * std::cos(angle) + v * std::sin(angle));
            for (const double height : {-drum.below, drum.above}) {
                lowest = std::min(lowest, glm::dot(direction, rim + drum.normal * height));
            }
        }
        EXPECT_LE(drum.lowest(direction), lowest + 1e-12) << i;
        EXPECT_NEAR(drum.lowest(direction), lowest, 1e-4 * drum.radius) << i;
    }
}

} // namespace
} // namespace elastoon
