// Based on: Chenney et al., NPAR 2002, section 3.2. The sharp reversal is done by a rule that does not depend on the
// step: docs/model.md, "The top of a steep throw".
#include "flight.h"

#include "contact.h"
#include "rotation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace elastoon {

namespace {

/// A direction in the plane of the parabola, by its parts up and across.
struct Heading {
    double up, across;
};

double climbOf(const Flight& flight, double elapsed) {
    return glm::dot(flight.velocity, flight.up) - glm::length(flight.gravity) * elapsed;
}

/// Direction of the axis as the rule lays it. Reversal: (v_z^2 + e^2) u + v_z v_h h.
Heading headingAt(const Flight& flight, double elapsed) {
    const double climb = climbOf(flight, elapsed);
    const double across = flight.speed_across;
    const double e = flight.reversal_speed;
    const Heading raw =
        flight.rule == AxisRule::Reversal ? Heading{climb * climb + e * e, climb * across} : Heading{climb, across};
    const double length = std::sqrt(raw.up * raw.up + raw.across * raw.across);
    return length > 0.0 ? Heading{raw.up / length, raw.across / length} : Heading{1.0, 0.0};
}

Vec3 worldOf(const Flight& flight, const Heading& heading) {
    return flight.up * heading.up + flight.across * heading.across;
}

/// Rotation in the plane of the parabola from one heading to another, stable up to the half turn.
Quat turnInPlane(const Flight& flight, const Heading& from, const Heading& to) {
    const double cosine = from.up * to.up + from.across * to.across;
    const double sine = from.up * to.across - from.across * to.up;
    double half_cosine = 0.0;
    double half_sine = 0.0;
    if (cosine >= 0.0) {
        half_cosine = std::sqrt(0.5 * (1.0 + cosine));
        half_sine = 0.5 * sine / half_cosine;
    } else {
        half_sine = std::sqrt(0.5 * (1.0 - cosine));
        half_sine = sine < 0.0 ? -half_sine : half_sine;
        half_cosine = 0.5 * sine / half_sine;
    }
    const Vec3 axis = glm::cross(flight.up, flight.across) * half_sine;
    return {half_cosine, axis.x, axis.y, axis.z};
}

double stretchAt(const Flight& flight, double speed) {
    const double scaled = flight.stretch_rate * speed;
    return (scaled * flight.max_stretch + 1.0) / (scaled + 1.0);
}

} // namespace

Flight beginFlight(const Pose& pose, const Vec3& velocity, const Vec3& gravity, const Style& style, Lead lead) {
    Flight flight;
    flight.position = pose.position;
    flight.velocity = velocity;
    flight.gravity = gravity;
    flight.max_stretch = style.max_stretch;
    flight.stretch_rate = style.stretch_rate;
    const double pull = glm::length(gravity);
    const double speed = glm::length(velocity);
    flight.up = pull > 0.0 ? -gravity / pull : (speed > 0.0 ? anyAcross(velocity / speed) : Vec3(0.0, 1.0, 0.0));
    const Vec3 sideways = velocity - flight.up * glm::dot(velocity, flight.up);
    flight.speed_across = glm::length(sideways);
    // A direction across that is pure rounding would turn the body about a random axis: call it none.
    if (flight.speed_across <= 1e-14 * speed) {
        flight.speed_across = 0.0;
    }
    flight.across = flight.speed_across > 0.0 ? sideways / flight.speed_across : anyAcross(flight.up);
    flight.reversal_speed = pull / style.reversal_rate;
    flight.rule = flight.speed_across < flight.reversal_speed ? AxisRule::Reversal
                  : speed > 0.0                               ? AxisRule::Velocity
                                                              : AxisRule::Fixed;
    flight.orientation = unitOf(pose.orientation);
    if (flight.rule != AxisRule::Fixed) {
        const Vec3 axis = principalAxis(flight.orientation);
        Vec3 target = leadingAxis(flight, 0.0);
        if (lead == Lead::Nearest && glm::dot(axis, target) < 0.0) {
            target = -target;
        }
        flight.orientation = unitOf(rotationBetween(axis, target) * flight.orientation);
    }
    return flight;
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
    pose.stretch = stretchAt(flight, glm::length(flightVelocity(flight, elapsed)));
    pose.orientation = flight.orientation;
    if (flight.rule != AxisRule::Fixed && flight.speed_across > 0.0) {
        const Quat turn = turnInPlane(flight, headingAt(flight, 0.0), headingAt(flight, elapsed));
        pose.orientation = turn * flight.orientation;
    }
    return pose;
}

Pose flightPose(const Flight& flight, const Shape& shape, double start, double elapsed) {
    Pose pose = unpushedPose(flight, elapsed);
    const double t = start + elapsed;
    if (t <= flight.leaving_until) {
        const double gap = gapTo(flight.leaving, shape, pose, t);
        if (gap < 0.0) {
            pose.position -= flight.leaving.normalAt(t) * gap;
        }
    }
    return pose;
}

double leavingUntil(const Surface& surface, double t, const Vec3& velocity, const Vec3& gravity, double least_speed) {
    const Vec3 normal = surface.normalAt(t);
    const double parting = glm::dot(velocity - surface.frame.velocityAt(t, surface.pointAt(t)), normal);
    const double pull = glm::dot(gravity, normal);
    if (parting <= least_speed && (pull < 0.0 || parting < 0.0)) {
        return -std::numeric_limits<double>::infinity();
    }
    return pull < 0.0 ? t + (parting - least_speed) / -pull : std::numeric_limits<double>::infinity();
}

FlightBounds flightBounds(const Flight& flight, const Shape& shape, double from, double to) {
    const double pull = glm::length(flight.gravity);
    const double first = climbOf(flight, from);
    const double last = climbOf(flight, to);
    const double least_climb = first * last <= 0.0 ? 0.0 : std::min(std::fabs(first), std::fabs(last));
    const double most_climb = std::max(std::fabs(first), std::fabs(last));
    const double across = flight.speed_across;
    const double least_speed = std::sqrt(least_climb * least_climb + across * across);

    FlightBounds bounds;
    bounds.speed = std::sqrt(most_climb * most_climb + across * across);
    const double along = stretchAt(flight, bounds.speed) * shape.reachAlong();
    bounds.reach = std::sqrt(along * along + shape.reachAcross() * shape.reachAcross());

    const double k = flight.stretch_rate;
    const double damped = k * least_speed + 1.0;
    const double stretch_rate = pull * k * (flight.max_stretch - 1.0) / (damped * damped);
    const double across_part = 0.5 * shape.reachAcross();
    const double lengthening =
        stretch_rate * std::sqrt(shape.reachAlong() * shape.reachAlong() + across_part * across_part);

    double turning = 0.0;
    if (across > 0.0 && pull > 0.0 && flight.rule != AxisRule::Fixed) {
        const double floor = flight.rule == AxisRule::Reversal ? flight.reversal_speed : across;
        turning = pull * across / (least_climb * least_climb + floor * floor);
    }
    bounds.shape_rate = turning * bounds.reach + lengthening;
    return bounds;
}

} // namespace elastoon
