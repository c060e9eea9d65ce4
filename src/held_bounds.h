// How far a body that is held by a surface, in an impact, in a slide or at rest, reaches, and how fast its points are.
#pragma once

#include "elastoon/phase.h"

#include <optional>

namespace elastoon {

/// Bounds for a body in an impact or at rest that hold at every time within [from, to].
struct HeldBounds {
    double reach = 0.0; ///< greatest distance of a point of the body from its centroid, m
    double speed = 0.0; ///< greatest speed of a point of the body in the world, m/s
};
[[nodiscard]] HeldBounds heldBounds(const Phase& phase, const Shape& shape, double from, double to);

/// A cylinder that stands on a surface, in the world.
struct Drum {
    Vec3 foot{0.0}; ///< of its axis, on the surface
    Vec3 normal{0.0}; ///< unit, of the surface
    double radius = 0.0, below = 0.0, above = 0.0; ///< m: from the axis, and how far it goes under and over the surface

    /// Least of `direction` . (x - foot) over its points.
    [[nodiscard]] double lowest(const Vec3& direction) const;
};

/// No point of a body in an impact on something that stands leaves that drum until `to`. None for any other phase, and
/// where something presses the body. `reach` as of heldBounds().
[[nodiscard]] std::optional<Drum> drumAboutContact(const Phase& phase, double reach, double to);

} // namespace elastoon
