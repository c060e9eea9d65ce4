// Groups of bounds: each bound in one of them, inside its ball, and questions answered as one by one.
#include "bound_groups.h"

#include "test_support.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace elastoon {
namespace {

std::vector<Bound> randomBounds(Random& random, int count) {
    std::vector<Bound> bounds;
    for (int i = 0; i < count; ++i) {
        const auto at = [&] { return static_cast<float>(random.uniform(-9.0, 9.0)); };
        const auto radius = static_cast<float>(random.uniform(0.05, 0.8));
        // Every third one lies on a lattice: coordinates tie there.
        bounds.push_back(i % 3 == 0
                             ? Bound{{static_cast<float>(i % 5), static_cast<float>(i % 7), 0.0F}, radius, radius}
                             : Bound{{at(), at(), at()}, radius, 0.7F * radius});
    }
    return bounds;
}

TEST(BoundGroups, HoldEachBoundOnce) {
    Random random(5);
    for (const int count : {0, 1, 2, 16, 17, 40, 333}) {
        const std::vector<Bound> bounds = randomBounds(random, count);
        const BoundGroups groups(bounds);
        std::vector<int> seen(bounds.size(), 0);
        for (const BoundGroup& group : groups.groups()) {
            for (const std::uint32_t index : group.members) {
                ++seen[index];
                EXPECT_LE(glm::length(bounds[index].centre - group.ball.centre) + bounds[index].radius,
                          group.ball.radius * 1.00001F);
                EXPECT_LE(bounds[index].radius, group.largest);
                EXPECT_LE(bounds[index].mean_radius, group.largest_mean);
            }
        }
        EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), count);
    }
}

TEST(BoundGroups, AnyAsksWhatOneByOneWould) {
    Random random(6);
    const std::vector<Bound> bounds = randomBounds(random, 200);
    const BoundGroups groups(bounds);
    int yes = 0, asked = 0;
    for (int i = 0; i < 8000; ++i) {
        const auto at = [&] { return static_cast<float>(random.uniform(-11.0, 11.0)); };
        const glm::vec3 point(at(), at(), at());
        const auto holds = [&](const Bound& bound) { return glm::length(bound.centre - point) < bound.radius; };
        const bool expected = std::any_of(bounds.begin(), bounds.end(), holds);
        const bool found = groups.any([&](const BoundGroup& group) { return holds(group.ball); },
                                      [&](std::size_t index) {
                                          ++asked;
                                          return holds(bounds[index]);
                                      });
        EXPECT_EQ(found, expected);
        yes += expected ? 1 : 0;
    }
    EXPECT_GT(yes, 20);
    EXPECT_LT(asked, 8000 * 200 / 8) << "groups must spare most of the questions";
}

} // namespace
} // namespace elastoon
