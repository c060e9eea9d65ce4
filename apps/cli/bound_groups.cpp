// See bound_groups.h.
#include "bound_groups.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace elastoon {

namespace {

constexpr std::size_t kFew = 16;      // bounds that are not worth grouping: each is a group, and all stays exact
constexpr std::size_t kMostMembers = 4;

BoundGroup groupOf(std::span<const Bound> bounds, std::span<const std::uint32_t> members) {
    BoundGroup group;
    group.members.assign(members.begin(), members.end());
    glm::vec3 low = bounds[members[0]].centre, high = low;
    float sections = 0.0F;
    for (const std::uint32_t index : members) {
        const Bound& bound = bounds[index];
        low = glm::min(low, bound.centre);
        high = glm::max(high, bound.centre);
        sections += bound.mean_radius * bound.mean_radius;
        group.largest = std::max(group.largest, bound.radius);
        group.largest_mean = std::max(group.largest_mean, bound.mean_radius);
    }
    group.ball.centre = members.size() == 1 ? low : (low + high) * 0.5F;
    group.ball.mean_radius = members.size() == 1 ? bounds[members[0]].mean_radius : std::sqrt(sections);
    for (const std::uint32_t index : members) {
        group.ball.radius =
            std::max(group.ball.radius, glm::length(bounds[index].centre - group.ball.centre) + bounds[index].radius);
    }
    return group;
}

/// Halves the indices at the median of their longest side until each part is small.
void split(std::span<const Bound> bounds, std::span<std::uint32_t> indices, std::vector<BoundGroup>& groups) {
    if (indices.size() <= kMostMembers) {
        groups.push_back(groupOf(bounds, indices));
        return;
    }
    glm::vec3 low = bounds[indices[0]].centre, high = low;
    for (const std::uint32_t index : indices) {
        low = glm::min(low, bounds[index].centre);
        high = glm::max(high, bounds[index].centre);
    }
    const glm::vec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    // By index where the coordinate ties: the groups are the same on every machine.
    std::sort(indices.begin(), indices.end(), [&](std::uint32_t a, std::uint32_t b) {
        const float at_a = bounds[a].centre[axis], at_b = bounds[b].centre[axis];
        return at_a != at_b ? at_a < at_b : a < b;
    });
    split(bounds, indices.first(indices.size() / 2), groups);
    split(bounds, indices.subspan(indices.size() / 2), groups);
}

} // namespace

BoundGroups::BoundGroups(std::span<const Bound> bounds) : bounds_(bounds) {
    std::vector<std::uint32_t> indices(bounds.size());
    std::iota(indices.begin(), indices.end(), 0U);
    if (bounds.size() > kFew) {
        split(bounds, indices, groups_);
        return;
    }
    for (const std::uint32_t& index : indices) {
        groups_.push_back(groupOf(bounds, {&index, 1}));
    }
}

} // namespace elastoon
