// Free flight: how it begins, its pose, and the bounds on its motion that the search for touches relies on.
#pragma once

#include "elastoon/phase.h"
#include "elastoon/style.h"

namespace elastoon {

/// Which end of a body leads when a flight turns it to its heading.
enum class Lead : std::uint8_t {
    PlusX,   ///< the +x end: a body that is made
    Nearest, ///< the end that has less to turn: everything later
};

/// A flight from this pose (stretch unused) with this velocity. Nothing is being left yet.
[[nodiscard]] Flight beginFlight(const Pose& pose, const Vec3& velocity, const Vec3& gravity, const Style& style,
                                 Lead lead);

/// Square of the share of the speed across gravity up to which it is pure rounding: its direction would be a random
/// one.
inline constexpr double kNothingAcross = 1e-28;

/// A weaker pull is none, m/s^2: squares of what follows from it would be nothing.
inline constexpr double kLeastPull = 1e-12;

/// Works out what follows from a flight's velocity, gravity and reversal speed.
void completeFlight(Flight& flight);

/// The ease that begins in one form (turn and stretch) and ends in the other.
[[nodiscard]] Ease easeBetween(const Pose& from, const Pose& to, double span);
/// Turns and stretches the pose by what is left of the ease.
void applyEase(const Ease& ease, double elapsed, Pose& pose);

/// Lets the flight begin in this pose (as to turn and stretch) and come to its own within `span` s.
void easeFrom(Flight& flight, const Pose& pose, double span);

[[nodiscard]] Vec3 flightVelocity(const Flight& flight, double elapsed);
/// Direction in which the leading end points (world, unit); with AxisRule::Fixed, the +x end.
[[nodiscard]] Vec3 leadingAxis(const Flight& flight, double elapsed);
/// Pose `elapsed` s after the flight began, not yet moved clear of what it leaves.
[[nodiscard]] Pose unpushedPose(const Flight& flight, double elapsed);

/// Until when a body whose flight begins at time t is to be kept clear of the surface that it leaves: as long as it
/// parts from it faster than `least_speed` along the normal and its bounding ball still reaches the plane. -infinity
/// when it does not part.
[[nodiscard]] double leavingUntil(const Surface& surface, double t, const Flight& flight, const Shape& shape,
                                  double least_speed);

/// A time from which on, at first, the bounding balls of the body and of the surface's solid are apart: the surface's
/// plane, which goes on beyond the solid, need not hold it any more. Infinity for a plane, and where none is found.
[[nodiscard]] double outOfReach(const Surface& surface, double t, const Flight& flight, const Shape& shape);

/// Bounds that hold at every time within [from, to] (s after the flight's begin).
struct FlightBounds {
    double reach = 0.0; ///< greatest distance of a point of the body from its centroid, m
    double speed = 0.0; ///< greatest speed of the unpushed centroid, m/s
    double longest = 1.0, flattest = 1.0; ///< stretches
};
[[nodiscard]] FlightBounds flightBounds(const Flight& flight, const Shape& shape, double from, double to);
/// Greatest speed of a point of the body relative to its centroid, m/s; `bounds` are those of the same times.
[[nodiscard]] double mostShapeRate(const Flight& flight, const Shape& shape, double from, double to,
                                   const FlightBounds& bounds);

} // namespace elastoon
