// When a body in flight first touches a plane or a convex solid: conservative advancement, finished by a bracketed
// root.
#pragma once

#include "closest.h"
#include "elastoon/phase.h"

#include <limits>
#include <optional>

namespace elastoon {

/// The body counts as touching at this share of its length: what separates a touch from rounding.
inline constexpr double kTouchGap = 1e-9;

inline constexpr double kNoGivingUp = std::numeric_limits<double>::infinity();

/// First time in [from, to] at which the flight's body touches the plane; it does not penetrate at that time.
/// None if there is no touch. At `from` a gap of kTouchGap or less is a touch. A touch that is sure to be later than
/// `give_up` need not be found; one that is found does not depend on it, not in the last bit.
[[nodiscard]] std::optional<double> firstTouch(const Phase& flight, const Shape& shape, const Surface& surface,
                                               double from, double to, double give_up = kNoGivingUp);

/// Sets the phase's `free_from`: a time from which on, for sure, the flight's own pose is clear of all that the phase
/// is kept clear of. It may be later than need be.
void findFreeFrom(Phase& flight, const Shape& shape);

/// That the phase is a flight that at t, and from then on, moves and meets as if it were kept clear of nothing.
[[nodiscard]] bool hasLeftAll(const Phase& phase, double t);

/// At this share of the body's length from a solid the body counts as touching it.
inline constexpr double kSolidTouchGap = 1e-8;

struct Touch {
    double time = 0.0;
    Surface surface; ///< a plane between the body and the solid, through the solid's nearest point, with the solid
};

/// First time in [from, to] at which the flight's body touches the solid, which is carried by `frame`. A body that
/// overlaps it at `from` touches it there. The seed is that of the last search of this pair.
[[nodiscard]] std::optional<Touch> firstSolidTouch(const Phase& flight, const Shape& shape, const ShapePtr& solid,
                                                   const MovingFrame& frame, double from, double to, ClosestSeed& seed,
                                                   double give_up = kNoGivingUp);

/// A plane (without its solid) between the surface's solid and a body that touches it at time t: it does not cut the
/// body. Of a surface without a solid, that plane. Its point lies under the contact.
[[nodiscard]] Surface separatingPlane(const Surface& surface, const Shape& shape, const Pose& pose, double t);

} // namespace elastoon
