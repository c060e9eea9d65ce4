// Where a posed body comes down on an edge of a solid: quick, for impacts that keep to the edge that was touched.
#pragma once

#include "elastoon/phase.h"
#include "line_contact.h"

#include <optional>

namespace elastoon {

/// As contactAlong() the surface's normal, where the surface touches an edge of its solid at its point, and the body
/// comes down within that edge. None elsewhere. All in the surface's frame.
[[nodiscard]] std::optional<LineContact> contactOnEdge(const Surface& surface, const Shape& shape,
                                                       const Pose& pose_in_frame);

/// As contactAlong() the direction, where the body comes down within this face of the solid. None elsewhere.
[[nodiscard]] std::optional<LineContact> contactOnFace(const Shape& solid, std::size_t face, const Shape& shape,
                                                       const Pose& pose_in_frame, const Vec3& direction);

/// contactAlong() the surface's normal: on the edge where that is where it comes down, or on a face beside it.
[[nodiscard]] std::optional<LineContact> contactOffFace(const Surface& surface, const Shape& shape,
                                                        const Pose& pose_in_frame);

} // namespace elastoon
