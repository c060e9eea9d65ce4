// The impact: what a touch makes of a flight, and the pose while the body squashes, turns and stretches at the contact.
#pragma once

#include "elastoon/phase.h"
#include "elastoon/style.h"

#include <optional>
#include <span>
#include <vector>

namespace elastoon {

/// A body in flight at the moment it touches.
struct Touching {
    double time = 0.0;
    Pose pose;
    Vec3 velocity{0.0};
    Vec3 gravity{0.0};
    Surface surface; ///< its point and normal, in its frame; the point may lie anywhere on the plane
    std::vector<Vec3> besides; ///< normals (world) of what else it touches
};

/// Whether the surface can hold a body of this style at rest at time t: it is level enough. Never without gravity.
[[nodiscard]] bool canHold(const Surface& surface, double t, const Vec3& gravity, const Style& style);

/// Whether surfaces with these normals, each too steep for it, hold a body between them, as a groove does.
[[nodiscard]] bool holdTogether(std::span<const Vec3> normals, const Vec3& gravity, const Style& style);

/// Until when, from time t on, the surface holds a body of this style: a turning one tips it off. Infinite: for good.
/// -infinity where it does not hold it at t.
[[nodiscard]] double holdsUntil(const Surface& surface, double t, const Vec3& gravity, const Style& style);

/// The impact that the touch begins, or none where the body is parting from the surface and not slow, or only brushes
/// it: then it flies on, pushed clear, with the speed along the normal reflected.
[[nodiscard]] std::optional<Impact> beginImpact(const Touching& touching, const Shape& shape, const Style& style);

/// A surface that is touched besides: its normal and what it does at the contact, in the primary surface's frame.
struct AlsoTouched {
    Vec3 normal{0.0};
    Vec3 velocity{0.0};
};

/// The impact from time t on (in its squash half) when the others throw the body back as well: no normal speed of
/// parting is less than the style's share of that of approach. CornerRule::Blended.
[[nodiscard]] Impact blendImpact(const Impact& impact, double t, std::span<const AlsoTouched> others,
                                 const Shape& shape, const Style& style, const Vec3& gravity);

/// The impact from time t on when the body shall leave it with this velocity (world). In the squash half it turns to
/// the new way, from the turn that it has; later its form stays what it was to be, and the flight eases it.
[[nodiscard]] Impact steeredImpact(const Impact& impact, double t, const Vec3& velocity, const Shape& shape,
                                   const Style& style, const Vec3& gravity);

/// Pose with the curve's stretch times `factor`.
[[nodiscard]] Pose impactPose(const Impact& impact, const Shape& shape, double t, double factor = 1.0);
[[nodiscard]] Vec3 impactVelocity(const Impact& impact, const Shape& shape, double t, double end);
/// Velocity (world) of the flight that follows, at the impact's end.
[[nodiscard]] Vec3 velocityAfter(const Impact& impact, double end);

} // namespace elastoon
