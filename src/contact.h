// A posed body against a plane: how far it is, how far it reaches, and where it touches.
#pragma once

#include "elastoon/phase.h"

namespace elastoon {

/// How far the body reaches from its centroid along `direction` (world, unit), m.
[[nodiscard]] double reachTowards(const Shape& shape, const Pose& pose, const Vec3& direction);

/// Distance of the body from the surface's plane at time t; negative where it penetrates. m.
[[nodiscard]] double gapTo(const Surface& surface, const Shape& shape, const Pose& pose, double t);

/// Middle of the region of the body that lies flat on a plane of this normal (world, towards the body): a vertex, the
/// middle of an edge, or the area centroid of a face. On the body's surface, world.
[[nodiscard]] Vec3 contactPoint(const Shape& shape, const Pose& pose, const Vec3& normal);

} // namespace elastoon
