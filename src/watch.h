// When a body that is held by one surface, in an impact or at rest, comes near to another obstacle. docs/contacts.md.
#pragma once

#include "elastoon/phase.h"
#include "touch.h"

#include <optional>
#include <span>

namespace elastoon {

/// Nearer than this share of its length, a body in an impact is kept clear of what it is near to.
inline constexpr double kNearGap = 1e-3;

/// What is watched: a plane, or a convex solid.
struct Watched {
    MovingFrame frame;
    Vec3 normal{0.0}; ///< of a plane, through the frame's origin
    ShapePtr solid;   ///< null for a plane
};

/// How far the body in this pose is from the obstacle at time t, with a plane between the two; below 0 only for planes.
struct Distance {
    double gap = 0.0;
    Surface plane;
};
[[nodiscard]] Distance distanceTo(const Watched& watched, const Shape& shape, const Pose& pose, double t,
                                  ClosestSeed& seed);

/// Who was come near to, and when, with a plane between the two.
struct Near {
    Touch touch;
    const Watched* watched;
};

/// A time in [from, to] at which the body is within `gap` m of one of the obstacles, the first or one before it has
/// come within half of that, with a plane between the two that does not cut the obstacle, nor the body unless the two
/// overlap. None if it stays further away.
[[nodiscard]] std::optional<Near> firstNear(const Phase& phase, const Shape& shape, std::span<const Watched> all,
                                            double from, double to, double gap);

} // namespace elastoon
