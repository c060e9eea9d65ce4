// How far a body that is held by a surface, in an impact, in a slide or at rest, reaches, and how fast its points are.
#pragma once

#include "elastoon/phase.h"

namespace elastoon {

/// Bounds for a body in an impact or at rest that hold at every time within [from, to].
struct HeldBounds {
    double reach = 0.0; ///< greatest distance of a point of the body from its centroid, m
    double speed = 0.0; ///< greatest speed of a point of the body in the world, m/s
};
[[nodiscard]] HeldBounds heldBounds(const Phase& phase, const Shape& shape, double from, double to);

/// About the contact of an impact on something that stands: no point of the body leaves that ball until `to`. Infinite
/// for any other phase, and where the body is kept clear of others. `reach` as of heldBounds().
[[nodiscard]] double ballAboutContact(const Phase& phase, double reach, double to);

} // namespace elastoon
