// The least shift out of half-spaces, and the one off a single plane beside what the search for it finds.
#include "push.h"

#include "contact.h"
#include "impact_support.h"
#include "test_support.h"

#include <algorithm>
#include <cmath>

namespace elastoon {
namespace {

std::vector<Barrier> randomBarriers(Random& random, int count) {
    std::vector<Barrier> barriers;
    for (int i = 0; i < count; ++i) {
        const Vec3 direction = random.direction();
        const double length = random.uniform(0.3, 1.0);
        barriers.push_back({direction * length, random.uniform(-1.0, 0.4)});
    }
    return barriers;
}

/// By Dykstra's alternating projections: slow, and another way to the same point.
Vec3 projected(const std::vector<Barrier>& barriers) {
    Vec3 x(0.0);
    std::vector<Vec3> memory(barriers.size(), Vec3(0.0));
    for (int round = 0; round < 20000; ++round) {
        for (std::size_t i = 0; i < barriers.size(); ++i) {
            const Vec3 y = x + memory[i];
            const Vec3& way = barriers[i].way;
            const double lack = -barriers[i].gap - glm::dot(way, y);
            x = lack > 0.0 ? y + way * (lack / glm::dot(way, way)) : y;
            memory[i] = y - x;
        }
    }
    return x;
}

TEST(Push, IsTheShortestWayOut) {
    Random random(41);
    int pushed = 0;
    int blocked = 0;
    int judged = 0;
    for (int i = 0; i < 300; ++i) {
        const auto barriers = randomBarriers(random, 1 + i % 4);
        const auto push = leastPush(barriers, 20.0);
        if (!push) {
            ++blocked;
            continue;
        }
        pushed += glm::length(*push) > 0.0 ? 1 : 0;
        for (const Barrier& barrier : barriers) {
            EXPECT_GE(barrier.gap + glm::dot(*push, barrier.way), -1e-12);
        }
        // The projections creep where planes all but oppose: until they arrive they judge nothing.
        const Vec3 other = projected(barriers);
        if (std::all_of(barriers.begin(), barriers.end(),
                        [&](const Barrier& barrier) { return barrier.gap + glm::dot(other, barrier.way) >= -1e-6; })) {
            ++judged;
            EXPECT_LT(glm::length(*push - other), 1e-3 * (1.0 + glm::length(*push))) << i;
        }
    }
    EXPECT_GT(judged, 200);
    EXPECT_GT(pushed, 150);
    EXPECT_LT(blocked, 30);
}

TEST(Push, ChangesContinuously) {
    Random random(42);
    for (int i = 0; i < 300; ++i) {
        auto barriers = randomBarriers(random, 3);
        const auto before = leastPush(barriers, 3.0);
        for (Barrier& barrier : barriers) {
            barrier.gap += 1e-7;
        }
        const auto after = leastPush(barriers, 3.0);
        if (before && after) {
            EXPECT_LT(glm::length(*before - *after), 1e-3);
        }
    }
}

TEST(Push, NoWayOutBetweenTwoThatOppose) {
    const Barrier between[] = {{{0, 1, 0}, -0.1}, {{0, -1, 0}, -0.1}};
    EXPECT_FALSE(leastPush(between, 10.0).has_value());
    EXPECT_TRUE(opposes({0, 1, 0}, {0, -1, 0}));
    EXPECT_FALSE(opposes({0, 1, 0}, {1, 0, 0}));
    EXPECT_FALSE(opposes({0, 1, 0}, {0, 1, 0}));
}

/// With another plane far away the shift is searched for.
TEST(Push, OffOnePlaneIsWhereTheSearchEnds) {
    Random random(43);
    int moved = 0;
    for (int i = 0; i < 300; ++i) {
        const auto struck = randomImpactByWall(random, i);
        if (!struck) {
            continue;
        }
        Phase searched = struck->phase;
        KeptClear far = searched.clear_of.front();
        far.surface.point = far.surface.point - 1e3 * far.surface.normal;
        searched.clear_of.push_back(far);
        for (int k = 0; k <= 20; ++k) {
            const double t = struck->phase.start + (struck->phase.end - struck->phase.start) * k / 20.0;
            const Fit fit = fitted(struck->phase, *struck->shape, t);
            const Fit other = fitted(searched, *struck->shape, t);
            EXPECT_EQ(fit.fits, other.fits) << i;
            EXPECT_LT(glm::length(fit.pose.position - other.pose.position), 1e-11) << i;
            moved += fit.fits && fit.moved() > 1e-3 ? 1 : 0;
        }
    }
    EXPECT_GT(moved, 500);
}

} // namespace
} // namespace elastoon
