// The bounds of a moment's things, in groups: shading asks each point about all of them, and with hundreds of things
// that is most of a picture's cost.
#pragma once

#include "ray_scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace elastoon {

/// Neighbours among the bounds.
struct BoundGroup {
    Bound ball; ///< holds the members' balls; its mean_radius makes up for all their volumes' sections
    float largest = 0.0F; ///< greatest radius of a member
    float largest_mean = 0.0F; ///< greatest mean radius
    std::vector<std::uint32_t> members; ///< indices of bounds
};

class BoundGroups {
public:
    explicit BoundGroups(std::span<const Bound> bounds);

    [[nodiscard]] std::span<const Bound> bounds() const { return bounds_; }
    [[nodiscard]] const std::vector<BoundGroup>& groups() const { return groups_; }

    /// Whether `is` holds for the index of any bound. `may_be` of a group: false only where it holds for no member.
    template <class MayBe, class Is>
    [[nodiscard]] bool any(const MayBe& may_be, const Is& is) const {
        for (const BoundGroup& group : groups_) {
            if (may_be(group)) {
                for (const std::uint32_t index : group.members) {
                    if (is(index)) {
                        return true;
                    }
                }
            }
        }
        return false;
    }

private:
    std::span<const Bound> bounds_;
    std::vector<BoundGroup> groups_;
};

} // namespace elastoon
