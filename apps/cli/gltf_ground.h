// Planes have no end; in a .glb file they are drawn as flat pieces that reach beyond the action.
#pragma once

#include "elastoon/math.h"

#include <vector>

namespace elastoon {

/// A box in the world.
struct ActionBounds {
    Vec3 low{0.0}, high{0.0};
    bool empty = true;

    void add(const Vec3& center, double reach);
    [[nodiscard]] Vec3 center() const { return 0.5 * (low + high); }
    [[nodiscard]] double size() const { return glm::length(high - low); }
};

/// A plane in the world; solid on the side that the normal (unit) points away from.
struct WorldPlane {
    Vec3 point{0.0};
    Vec3 normal{0.0, 1.0, 0.0};
};

/// A square of the plane about the action, counter-clockwise seen from the open side, less what is hidden within the
/// solid sides of the other planes.
[[nodiscard]] std::vector<Vec3> visiblePiece(const WorldPlane& plane, const ActionBounds& bounds,
                                             const std::vector<WorldPlane>& others);

} // namespace elastoon
