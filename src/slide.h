// Sliding along a surface: when a touch begins it, its pose, and when it ends. docs/contacts.md.
#pragma once

#include "elastoon/phase.h"
#include "elastoon/style.h"
#include "impact.h"

#include <optional>

namespace elastoon {

struct SlideBegun {
    Slide slide;
    double duration =
        0.0; ///< s, until it stops, or turns so far that friction needs a new direction, or leaves the face
};

/// The slide that the touch begins, or none: where the body meets the surface too fast along the normal, or is slow
/// enough along it to come to rest, or there is no face under it, or the surface turns or is too steep.
[[nodiscard]] std::optional<SlideBegun> beginSlide(const Touching& touching, const Shape& shape, const Style& style);

/// Pose at time t with the slide's stretch times `factor`.
[[nodiscard]] Pose slidePose(const Slide& slide, const Shape& shape, double t, double factor = 1.0);
/// At this speed along the surface, without the ease.
[[nodiscard]] double slideStretch(const Slide& slide, double speed);
/// At time t, in the frame, along the surface.
[[nodiscard]] Vec3 slideVelocity(const Slide& slide, double t);

/// Time from which on the foot + velocity t + acceleration t^2 / 2 (in the frame) is off the solid's face under the
/// surface's plane. Infinite on a plane; 0 where the foot is on no face.
[[nodiscard]] double timeOnFace(const Surface& surface, const Vec3& foot, const Vec3& velocity,
                                const Vec3& acceleration);
/// The way from the face (zero: it is on it) to the foot (in the frame).
[[nodiscard]] Vec3 wayOffFace(const Surface& surface, const Vec3& foot);

} // namespace elastoon
