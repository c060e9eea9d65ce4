// See state_check.h. The bounds are wide: numbers that are merely odd may pass.
#include "state_check.h"

#include "check_input.h"
#include "topology.h"

#include <cmath>

namespace elastoon {

namespace {

constexpr double kFarthest = 1e15; ///< m
constexpr double kFastest = 1e8; ///< m/s
/// What moves obstacles is bounded at the door; a search for touches takes the longer the faster they are.
constexpr double kRounded = 1.0 + 1e-6;
constexpr double kMostStretch = 1e6;
constexpr double kUnit = 1e-6; ///< what a unit vector's square may be off
constexpr double kHalfPi = 1.5707963267948966;

bool within(double value, double least, double most) {
    return value >= least && value <= most;
}

bool within(const Vec3& v, double most) {
    return std::fabs(v.x) <= most && std::fabs(v.y) <= most && std::fabs(v.z) <= most;
}

bool isUnit(const Vec3& v) {
    return std::fabs(glm::dot(v, v) - 1.0) <= kUnit;
}

bool isUnit(const Quat& q) {
    return std::fabs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1.0) <= kUnit;
}

bool isTime(double t) {
    return std::fabs(t) <= 2.0 * kMostTime;
}

bool isStretch(double s) {
    return within(s, 1.0 / kMostStretch, kMostStretch);
}

const char* flawOf(const MovingFrame& frame) {
    if (!isTime(frame.start)) {
        return "a frame's start must be a time within +-2e9 s";
    }
    if (!within(frame.origin, kFarthest) || !within(frame.velocity, kRounded * kMostSpeed) ||
        !within(frame.angular_velocity, kRounded * kMostSpin)) {
        return "a frame must be within 1e15 m, 1e6 m/s and 1e4 rad/s";
    }
    return isUnit(frame.orientation) ? nullptr : "a frame's orientation must be a unit quaternion";
}

} // namespace

const char* flawOf(const Surface& surface) {
    if (const char* flaw = flawOf(surface.frame)) {
        return flaw;
    }
    if (!within(surface.point, kFarthest)) {
        return "a surface's point must be within 1e15 m";
    }
    return isUnit(surface.normal) ? nullptr : "a surface's normal must be a unit vector";
}

namespace {

const char* flawOf(const Ease& ease) {
    const bool sound = within(ease.span, 0.0, kMostTime) && (ease.span == 0.0 || ease.span >= 1e-9) &&
                       isUnit(ease.axis) && std::fabs(ease.angle) <= 100.0 && isStretch(ease.stretch);
    return sound ? nullptr : "an ease must have a span of 0 or from 1e-9 s, a unit axis and a positive stretch";
}

bool stretches(double max_stretch, double stretch_rate) {
    return within(max_stretch, 1.0, 1.01e2) && within(stretch_rate, 0.0, 1.01e3);
}

const char* flawOf(const Flight& flight, double /*now*/) {
    if (!within(flight.position, kFarthest) || !within(flight.velocity, kFastest) ||
        !within(flight.gravity, 2.0 * kMostGravity)) {
        return "a flight must be within 1e15 m and 1e8 m/s, its gravity within 1e6 m/s^2";
    }
    if (!isUnit(flight.orientation)) {
        return "a flight's orientation must be unit";
    }
    if (!within(flight.reversal_speed, 0.0, kFastest)) {
        return "a flight's reversal speed must not be negative";
    }
    if (!stretches(flight.max_stretch, flight.stretch_rate)) {
        return "a flight's max_stretch must be from 1 to 100, its stretch_rate from 0 to 1000";
    }
    return flawOf(*flight.ease);
}

/// A quarter of a period, or no time at all.
bool isHalf(double omega, double span) {
    return (omega == 0.0 && span == 0.0) ||
           (within(omega, 0.0, 1e18) && within(span, 0.0, 1e18) && std::fabs(omega * span - kHalfPi) <= kUnit);
}

const char* flawOf(const Impact& impact, double now) {
    if (const char* flaw = flawOf(impact.surface)) {
        return flaw;
    }
    const ImpactCurve& curve = impact.curve;
    if (!isTime(impact.begun) || impact.begun > now) {
        return "an impact must have begun before now";
    }
    if (!isStretch(curve.s_in) || !isStretch(curve.s_mid) || !isStretch(curve.s_out) ||
        !isHalf(curve.omega_in, curve.t_in) || !isHalf(curve.omega_out, curve.t_out)) {
        return "an impact's curve must have positive stretches and two quarters of a period";
    }
    if (!isUnit(impact.orientation) || !isUnit(impact.turn_axis) || !(std::fabs(impact.turn_angle) <= 100.0) ||
        !(impact.turn_from >= 0.0 && impact.turn_from < 1.0)) {
        return "an impact's orientation and axis must be unit, its turn finite and begun from 0 to below 1";
    }
    if (!within(impact.contact_in_shape, kFarthest) || !within(impact.skims, kFastest) ||
        !within(impact.velocity_in, kFastest) || !within(impact.velocity_out, kFastest)) {
        return "an impact must be within 1e15 m and 1e8 m/s";
    }
    return impact.easing <= ImpactEasing::Linear ? nullptr : "an impact's easing must be one of the two";
}

const char* flawOf(const Rest& rest, double /*now*/) {
    if (const char* flaw = flawOf(rest.surface)) {
        return flaw;
    }
    const bool sound =
        within(rest.pose.position, kFarthest) && isUnit(rest.pose.orientation) && isStretch(rest.pose.stretch);
    return sound ? nullptr : "a resting pose must be within 1e15 m, unit and of positive stretch";
}

const char* flawOf(const Slide& slide, double now) {
    if (const char* flaw = flawOf(slide.surface)) {
        return flaw;
    }
    if (!isTime(slide.begun) || slide.begun > now) {
        return "a slide must have begun before now";
    }
    if (!within(slide.foot, kFarthest) || !within(slide.velocity, kFastest) || !within(slide.acceleration, 1e9)) {
        return "a slide must be within 1e15 m, 1e8 m/s and 1e9 m/s^2";
    }
    if (!isUnit(slide.direction) || !isUnit(slide.orientation)) {
        return "a slide's direction and orientation must be unit";
    }
    return stretches(slide.max_stretch, slide.stretch_rate)
               ? flawOf(slide.ease)
               : "a slide's max_stretch must be from 1 to 100, its stretch_rate from 0 to 1000";
}

const char* flawOf(const Path& path, double now) {
    if (path.keys.empty()) {
        return nullptr;
    }
    if (!isTime(path.added) || path.added > now) {
        return "a path must have been added before now";
    }
    const auto isPlace = [](const Vec3& position, const Quat& rotation) {
        const double square = glm::dot(rotation, rotation);
        return within(position, kFarthest) && square > 1e-20 && square <= 1e200;
    };
    if (!isPlace(path.position, path.rotation)) {
        return "a path must begin within 1e15 m, with a rotation that is not zero";
    }
    double last = 0.0;
    for (const PathKey& key : path.keys) {
        if (!(key.time > last && key.time <= kMostStep && isPlace(key.position, key.rotation))) {
            return "a path's keys must ascend in time, within 1e6 s and 1e15 m";
        }
        last = key.time;
    }
    return !path.repeats || last >= kLeastLap ? nullptr : "a path that repeats must take a millisecond at least";
}

} // namespace

const char* flawOf(const Phase& phase, double now) {
    if (std::isnan(phase.free_from)) {
        return "the time from which on it is free must be a number";
    }
    if (!isTime(phase.start) || phase.start > now) {
        return "a phase must have begun before now";
    }
    // A step ends what is due in it: an end that is past would be made up for at length.
    if (!(phase.end >= now - 1e-9 * (1.0 + now))) {
        return "a phase must not have ended before now";
    }
    for (const KeptClear& kept : phase.clear_of) {
        if (const char* flaw = flawOf(kept.surface)) {
            return flaw;
        }
        if (!isTime(kept.since) || std::isnan(kept.until)) {
            return "what a body is kept clear of must have times";
        }
    }
    if (const auto* impact = phase.as<Impact>()) {
        return flawOf(*impact, now);
    }
    if (const auto* slide = phase.as<Slide>()) {
        return flawOf(*slide, now);
    }
    return phase.is<Rest>() ? flawOf(phase.get<Rest>(), now) : flawOf(phase.get<Flight>(), now);
}

const char* flawOf(const Event& event) {
    const double numbers[] = {event.time, event.speed, event.s_in, event.s_mid, event.s_out, event.t_in, event.t_out};
    bool sound = event.type <= EventType::Squeeze && within(event.point, 1e300) && within(event.normal, 2.0);
    for (const double number : numbers) {
        sound = sound && std::isfinite(number);
    }
    return sound ? nullptr : "an event must be one of the five, with finite numbers";
}

const char* flawOf(const ObstacleSlot& slot, double now) {
    if (const char* flaw = flawOf(slot.frame)) {
        return flaw;
    }
    return isUnit(slot.normal) ? flawOf(slot.path, now) : "an obstacle's normal must be a unit vector";
}

} // namespace elastoon
