// A posed body against a plane: how far it is, how far it reaches, and where it touches.
#pragma once

#include "elastoon/phase.h"

#include <optional>

namespace elastoon {

/// How far the body reaches from its centroid along `direction` (world, unit), m.
[[nodiscard]] double reachTowards(const Shape& shape, const Pose& pose, const Vec3& direction);

/// The furthest point of the body in `direction` (world, any length). Of several, one.
[[nodiscard]] Vec3 furthestPoint(const Shape& shape, const Pose& pose, const Vec3& direction);

/// Whether the point, seen along the face's normal, lies on the solid's face; all in the solid's frame.
[[nodiscard]] bool isOverFace(const Shape& solid, std::size_t face, const Vec3& point);

/// The face of the surface's solid that the surface's plane holds, if there is one and the solid's faces are few.
[[nodiscard]] std::optional<std::size_t> faceOf(const Surface& surface);

/// How far the body must be moved along the surface's normal (both in the frame, m) so that it just touches the solid,
/// or the plane where there is none or the body passes it by. Negative where it is clear.
[[nodiscard]] double liftToTouch(const Surface& surface, const Shape& shape, const Pose& pose_in_frame);

/// The same where the body comes down within the face that the surface's plane holds, which most do: quick. None
/// elsewhere.
[[nodiscard]] std::optional<double> liftOntoFace(const Surface& surface, const Shape& shape, const Pose& pose_in_frame);

/// Distance of the body from the surface's plane at time t; negative where it penetrates. m.
[[nodiscard]] double gapTo(const Surface& surface, const Shape& shape, const Pose& pose, double t);

/// Middle of the region in which a body touches the surface at time t: a vertex, the middle of an edge, the area
/// centroid of a face; where there is a solid, of the region that the two share. On the body, world.
[[nodiscard]] Vec3 contactPoint(const Shape& shape, const Pose& pose, const Surface& surface, double t);

} // namespace elastoon
