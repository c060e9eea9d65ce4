// Based on: Chenney et al., NPAR 2002, section 3.2. The sharp reversal is done by a rule that does not depend on the
// step: docs/model.md, "The top of a steep throw".
#include "flight.h"

#include "dmath.h"
#include "rotation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace elastoon {

namespace {

double climbOf(const Flight& flight, double elapsed) {
    return flight.climb - flight.pull * elapsed;
}

/// A direction in the plane of the parabola, by its parts up and across.
struct Heading {
    double up, across;
};

/// Direction of the axis as the rule lays it, of any length. Reversal: (v_z^2 + e^2) u + v_z v_h h.
Heading rawHeadingAt(const Flight& flight, double elapsed) {
    const double climb = climbOf(flight, elapsed);
    const double across = flight.speed_across;
    const double e = flight.reversal_speed;
    return flight.rule == AxisRule::Reversal ? Heading{climb * climb + e * e, climb * across} : Heading{climb, across};
}

Heading headingAt(const Flight& flight, double elapsed) {
    const Heading raw = rawHeadingAt(flight, elapsed);
    const double length = std::sqrt(raw.up * raw.up + raw.across * raw.across);
    return length > 0.0 ? Heading{raw.up / length, raw.across / length} : Heading{1.0, 0.0};
}

Vec3 worldOf(const Flight& flight, const Heading& heading) {
    return flight.up * heading.up + glm::cross(flight.turn_axis, flight.up) * heading.across;
}

/// The turn from straight up to the heading, in the plane of the parabola; stable up to straight down.
inline Quat turnFromUp(const Flight& flight, double elapsed) {
    const Heading raw = rawHeadingAt(flight, elapsed);
    // Half of the angle is that of (length + |up|, across).
    const double length = std::sqrt(raw.up * raw.up + raw.across * raw.across);
    const double sum = length + std::fabs(raw.up);
    const double inverse = 1.0 / std::sqrt(2.0 * length * sum);
    const double larger = sum * inverse;
    const double smaller = raw.across * inverse;
    const bool acute = raw.up >= 0.0;
    const Vec3 axis = flight.turn_axis * (acute ? smaller : larger);
    return {acute ? larger : smaller, axis.x, axis.y, axis.z};
}

/// Its speed squared is that up and that across: what is across stays.
double speedAt(const Flight& flight, double elapsed) {
    const double climb = climbOf(flight, elapsed);
    return std::sqrt(climb * climb + flight.speed_across * flight.speed_across);
}

double stretchAt(const Flight& flight, double speed) {
    const double scaled = flight.stretch_rate * speed;
    return (scaled * flight.max_stretch + 1.0) / (scaled + 1.0);
}

} // namespace

void completeFlight(Flight& flight) {
    const double speed = glm::length(flight.velocity);
    flight.pull = glm::length(flight.gravity);
    if (flight.pull <= kLeastPull) {
        flight.gravity = Vec3(0.0);
        flight.pull = 0.0;
    }
    const bool falls = flight.pull > 0.0;
    flight.up = falls ? -flight.gravity / flight.pull
                      : (speed > 0.0 ? anyAcross(flight.velocity / speed) : Vec3(0.0, 1.0, 0.0));
    flight.climb = falls ? glm::dot(flight.velocity, flight.up) : 0.0;
    const Vec3 sideways = flight.velocity - flight.up * flight.climb;
    const double square = glm::dot(sideways, sideways);
    const bool is_none = square <= kNothingAcross * (flight.climb * flight.climb);
    flight.speed_across = is_none ? 0.0 : std::sqrt(square);
    flight.turn_axis = glm::cross(flight.up, is_none ? anyAcross(flight.up) : sideways * (1.0 / flight.speed_across));
    flight.rule = flight.speed_across < flight.reversal_speed ? AxisRule::Reversal
                  : speed > 0.0                               ? AxisRule::Velocity
                                                              : AxisRule::Fixed;
}

Flight beginFlight(const Pose& pose, const Vec3& velocity, const Vec3& gravity, const Style& style, Lead lead) {
    Flight flight;
    flight.position = pose.position;
    flight.velocity = velocity;
    flight.gravity = gravity;
    flight.max_stretch = style.max_stretch;
    flight.stretch_rate = style.stretch_rate;
    flight.reversal_speed = glm::length(gravity) / style.reversal_rate;
    completeFlight(flight);
    flight.orientation = unitOf(pose.orientation);
    if (flight.rule != AxisRule::Fixed) {
        const Vec3 axis = principalAxis(flight.orientation);
        Vec3 target = leadingAxis(flight, 0.0);
        if (lead == Lead::Nearest && glm::dot(axis, target) < 0.0) {
            target = -target;
        }
        flight.orientation = rotationBetween(axis, target) * flight.orientation;
        if (flight.pull > 0.0) {
            flight.orientation = glm::conjugate(turnFromUp(flight, 0.0)) * flight.orientation;
        }
        flight.orientation = unitOf(flight.orientation);
    }
    return flight;
}

Ease easeBetween(const Pose& from, const Pose& to, double span) {
    const Quat turn = unitOf(from.orientation) * glm::conjugate(to.orientation);
    const double sine = std::sqrt(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);
    Ease ease;
    ease.span = span;
    ease.stretch = from.stretch;
    if (sine > 0.0) {
        const double sign = turn.w < 0.0 ? -1.0 : 1.0;
        ease.axis = Vec3(turn.x, turn.y, turn.z) * (sign / sine);
        ease.angle = 2.0 * detAtan2(sine, std::fabs(turn.w));
    }
    return ease;
}

void applyEase(const Ease& ease, double elapsed, Pose& pose) {
    if (elapsed < ease.span) {
        const double done = elapsed / ease.span;
        const double left = 1.0 - done * done * (3.0 - 2.0 * done);
        pose.stretch += (ease.stretch - pose.stretch) * left;
        pose.orientation = rotationAbout(ease.axis, ease.angle * left) * pose.orientation;
    }
}

void easeFrom(Flight& flight, const Pose& pose, double span) {
    flight.ease = easeBetween(pose, unpushedPose(flight, 0.0), span);
}

Vec3 flightVelocity(const Flight& flight, double elapsed) {
    return flight.velocity + flight.gravity * elapsed;
}

Vec3 leadingAxis(const Flight& flight, double elapsed) {
    if (flight.rule == AxisRule::Fixed) {
        return principalAxis(flight.orientation);
    }
    const Vec3 axis = worldOf(flight, headingAt(flight, elapsed));
    return flight.rule == AxisRule::Reversal && climbOf(flight, elapsed) <= 0.0 ? -axis : axis;
}

Pose unpushedPose(const Flight& flight, double elapsed) {
    Pose pose;
    pose.position = flight.position + (flight.velocity + flight.gravity * (0.5 * elapsed)) * elapsed;
    pose.stretch = stretchAt(flight, speedAt(flight, elapsed));
    pose.orientation = flight.pull > 0.0 ? turnFromUp(flight, elapsed) * flight.orientation : flight.orientation;
    applyEase(*flight.ease, elapsed, pose);
    return pose;
}

double leavingUntil(const Surface& surface, double t, const Flight& flight, const Shape& shape, double least_speed) {
    const Vec3 normal = surface.normalAt(t);
    const double parting = glm::dot(flight.velocity - surface.frame.velocityAt(t, surface.pointAt(t)), normal);
    const double pull = glm::dot(flight.gravity, normal);
    if (parting <= least_speed && (pull < 0.0 || parting < 0.0)) {
        return -std::numeric_limits<double>::infinity();
    }
    const double parts_for = pull < 0.0 ? (parting - least_speed) / -pull : std::numeric_limits<double>::infinity();
    if (const double spin = glm::length(surface.frame.angular_velocity); spin > 0.0 || !(parting > 0.0)) {
        // Beyond this turn (rad) the plane is another one.
        constexpr double kMostTurn = 0.25;
        return t + std::min(parts_for, spin > 0.0 ? kMostTurn / spin : parts_for);
    }
    const double height = glm::dot(flight.position - surface.pointAt(t), normal);
    for (double span = shape.length() / parting; span < parts_for; span *= 2.0) {
        const double way = 1.01 * flightBounds(flight, shape, 0.0, span).reach - height;
        const double discriminant = parting * parting + 2.0 * pull * way;
        if (way <= 0.0 || (discriminant > 0.0 && 2.0 * way <= span * (parting + std::sqrt(discriminant)))) {
            return t + std::min(parts_for, span);
        }
    }
    return t + parts_for;
}

double outOfReach(const Surface& surface, double t, const Flight& flight, const Shape& shape) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    constexpr int kLooks = 64;
    if (!surface.solid) {
        return kNever;
    }
    const MovingFrame& frame = surface.frame;
    const double radius = surface.solid->boundingRadius();
    const double way = radius + shape.boundingRadius();
    const double pull = flight.pull;
    const double by_speed = way / glm::length(flight.velocity - frame.velocity);
    const double step = 0.25 * std::min(by_speed, std::sqrt(way / pull));
    for (int i = 1; i <= kLooks && step < kNever; ++i) {
        const double elapsed = i * step;
        const Vec3 position = flight.position + (flight.velocity + flight.gravity * (0.5 * elapsed)) * elapsed;
        const double reach = flightBounds(flight, shape, elapsed, elapsed).reach;
        if (glm::length(position - frame.originAt(t + elapsed)) > radius + reach) {
            return t + elapsed;
        }
    }
    return kNever;
}

FlightBounds flightBounds(const Flight& flight, const Shape& shape, double from, double to) {
    const double climb = std::max(std::fabs(climbOf(flight, from)), std::fabs(climbOf(flight, to)));
    FlightBounds bounds;
    bounds.speed = std::sqrt(climb * climb + flight.speed_across * flight.speed_across);
    bounds.longest = stretchAt(flight, bounds.speed);
    double widening = 1.0;
    if (from < flight.ease->span) {
        bounds.longest = std::max(bounds.longest, flight.ease->stretch);
        bounds.flattest = std::min(1.0, flight.ease->stretch);
        widening = 1.0 / std::sqrt(bounds.flattest);
    }
    const double along = bounds.longest * shape.reachAlong();
    const double across = shape.reachAcross() * widening;
    bounds.reach = std::min(std::sqrt(along * along + across * across),
                            shape.boundingRadius() * std::max(bounds.longest, widening));
    return bounds;
}

double mostShapeRate(const Flight& flight, const Shape& shape, double from, double to, const FlightBounds& bounds) {
    const double pull = flight.pull;
    const double first = climbOf(flight, from);
    const double last = climbOf(flight, to);
    const double least_climb = first * last <= 0.0 ? 0.0 : std::min(std::fabs(first), std::fabs(last));
    const double across = flight.speed_across;
    const double least_speed = std::sqrt(least_climb * least_climb + across * across);

    const double k = flight.stretch_rate;
    const double damped = k * least_speed + 1.0;
    // The easing's slope is at most 1.5.
    const double easing = from < flight.ease->span ? 1.5 / flight.ease->span : 0.0;
    const double stretch_rate =
        pull * k * (flight.max_stretch - 1.0) / (damped * damped) + easing * (bounds.longest - bounds.flattest);
    const double thin = bounds.flattest < 1.0 ? bounds.flattest * std::sqrt(bounds.flattest) : 1.0;
    const double across_part = 0.5 * shape.reachAcross() / thin;
    const double lengthening =
        stretch_rate * std::sqrt(shape.reachAlong() * shape.reachAlong() + across_part * across_part);

    double turning = easing * flight.ease->angle;
    if (across > 0.0 && pull > 0.0 && flight.rule != AxisRule::Fixed) {
        const double floor = flight.rule == AxisRule::Reversal ? flight.reversal_speed : across;
        turning += pull * across / (least_climb * least_climb + floor * floor);
    }
    return turning * bounds.reach + lengthening;
}

} // namespace elastoon
