// See step.h: from event to event, phase to phase. Paper, section 3, the three steps of a time step.
#include "step.h"

#include "contact.h"
#include "impact.h"
#include "touch.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace elastoon {

namespace {

/// More events than this in one step of one body: it waits for the next step where it is. Only steps of many minutes,
/// or a body wedged between surfaces, come near it.
constexpr int kMostEventsPerStep = 4096;

constexpr double kNever = std::numeric_limits<double>::infinity();

struct Met {
    double time = kNever;
    std::size_t obstacle = 0;
};

/// Speed of parting below which a surface is not left any more but met: it rests there if it can.
double leastPartingSpeed(const Surroundings& around, const BodySlot& body, const Surface& surface, double t) {
    return canHold(surface, t, around.gravity, body.style)
               ? restSpeed(body.style, body.shape->length(), glm::length(around.gravity))
               : 0.0;
}

/// The earliest touch within [from, to]; of equal ones that of the obstacle added first.
/// The surface being left is not looked at until it is left.
Met earliestTouch(const Surroundings& around, const BodySlot& body, double from, double to) {
    const auto& flight = std::get<Flight>(body.phase.motion);
    Met met;
    for (std::size_t i = 0; i < around.obstacles.size(); ++i) {
        const ObstacleSlot& obstacle = around.obstacles[i];
        if (!obstacle.used || !obstacle.isPlane()) {
            continue;
        }
        const bool left = flight.leaving_until > from && body.phase.obstacle == idOfObstacle(i, obstacle);
        const double begin = left ? flight.leaving_until : from;
        const double end = std::min(to, met.time);
        if (begin > end) {
            continue;
        }
        const auto touch = firstTouch(body.phase, *body.shape, obstacle.surface(), begin, end);
        if (touch && *touch < met.time) {
            met = {*touch, i};
        }
    }
    return met;
}

Event eventOf(EventType type, double t, BodyId id, const Phase& phase, const Surface& surface, double speed,
              const ImpactCurve& curve) {
    return {.time = t,
            .type = type,
            .body = id,
            .other = phase.obstacle,
            .point = surface.pointAt(t),
            .normal = surface.normalAt(t),
            .speed = speed,
            .s_in = curve.s_in,
            .s_mid = curve.s_mid,
            .s_out = curve.s_out,
            .t_in = curve.t_in,
            .t_out = curve.t_out};
}

/// The flight ends in an impact, or goes on pushed clear of a surface that it brushes while parting from it.
void meet(const Surroundings& around, BodySlot& body, BodyId id, const Met& met, Happenings& out) {
    const ObstacleSlot& obstacle = around.obstacles[met.obstacle];
    const Touching touching{.time = met.time,
                            .pose = poseAt(body.phase, *body.shape, met.time),
                            .velocity = velocityAt(body.phase, *body.shape, met.time),
                            .gravity = around.gravity,
                            .surface = obstacle.surface()};
    const std::optional<Impact> impact = beginImpact(touching, *body.shape, body.style);
    if (!impact) {
        beginFlying(around, body, id, met.time, touching.pose, touching.velocity, Lead::Nearest, out);
        return;
    }
    Phase phase;
    phase.start = met.time;
    phase.end = met.time + impact->curve.duration();
    phase.obstacle = idOfObstacle(met.obstacle, obstacle);
    phase.motion = *impact;
    const Vec3 contact = impact->surface.pointAt(met.time);
    const double speed = glm::length(touching.velocity - obstacle.frame.velocityAt(met.time, contact));
    out.events.push_back(eventOf(EventType::Impact, met.time, id, phase, impact->surface, speed, impact->curve));
    beginPhase(body, id, phase, out);
}

/// The impact is over: the body flies off, or rests.
void endImpact(const Surroundings& around, BodySlot& body, BodyId id, Happenings& out) {
    const Phase phase = body.phase;
    const auto& impact = std::get<Impact>(phase.motion);
    const double t = phase.end;
    const Pose pose = poseAt(phase, *body.shape, t);
    const double speed = glm::length(impact.velocity_out);
    if (!impact.comes_to_rest) {
        out.events.push_back(eventOf(EventType::Release, t, id, phase, impact.surface, speed, impact.curve));
        beginFlying(around, body, id, t, pose, velocityAfter(impact, t), Lead::Nearest, out);
        return;
    }
    const MovingFrame& frame = impact.surface.frame;
    Rest rest;
    rest.surface = impact.surface;
    rest.pose.position = frame.frameFromWorld(t, pose.position);
    rest.pose.orientation = glm::conjugate(frame.orientationAt(t)) * pose.orientation;
    rest.pose.stretch = 1.0;
    Phase next;
    next.start = t;
    next.obstacle = phase.obstacle;
    next.motion = rest;
    out.events.push_back(eventOf(EventType::Rest, t, id, next, impact.surface, speed, impact.curve));
    beginPhase(body, id, next, out);
}

} // namespace

void beginPhase(BodySlot& body, BodyId id, const Phase& phase, Happenings& out) {
    body.phase = phase;
    out.phases.push_back({id, body.phase});
}

void beginFlying(const Surroundings& around, BodySlot& body, BodyId id, double t, const Pose& pose,
                 const Vec3& velocity, Lead lead, Happenings& out) {
    Phase phase;
    phase.start = t;
    Flight flight = beginFlight(pose, velocity, around.gravity, body.style, lead);
    const Pose first = unpushedPose(flight, 0.0);
    double deepest = kTouchGap * body.shape->length();
    for (std::size_t i = 0; i < around.obstacles.size(); ++i) {
        const ObstacleSlot& obstacle = around.obstacles[i];
        if (!obstacle.used || !obstacle.isPlane()) {
            continue;
        }
        Surface surface = obstacle.surface();
        const double gap = gapTo(surface, *body.shape, first, t);
        if (gap > deepest) {
            continue;
        }
        surface.point = surface.frame.frameFromWorld(t, contactPoint(*body.shape, first, surface.normalAt(t)) -
                                                            surface.normalAt(t) * gap);
        const double until =
            leavingUntil(surface, t, velocity, around.gravity, leastPartingSpeed(around, body, surface, t));
        if (until > t) {
            deepest = gap;
            flight.leaving = surface;
            flight.leaving_until = until;
            phase.obstacle = idOfObstacle(i, obstacle);
        }
    }
    phase.motion = flight;
    beginPhase(body, id, phase, out);
}

void advanceBody(const Surroundings& around, BodySlot& body, BodyId id, double from, double to, Happenings& out) {
    double t = from;
    for (int i = 0; i < kMostEventsPerStep; ++i) {
        if (std::holds_alternative<Rest>(body.phase.motion)) {
            return;
        }
        if (std::holds_alternative<Impact>(body.phase.motion)) {
            if (body.phase.end > to) {
                return;
            }
            t = body.phase.end;
            endImpact(around, body, id, out);
            continue;
        }
        const Met met = earliestTouch(around, body, t, to);
        if (met.time == kNever) {
            return;
        }
        t = met.time;
        meet(around, body, id, met, out);
    }
    const Pose pose = poseAt(body.phase, *body.shape, t);
    beginFlying(around, body, id, to, pose, velocityAt(body.phase, *body.shape, t), Lead::Nearest, out);
}

} // namespace elastoon
