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

/// More than this many without any time between them: likewise.
constexpr int kMostEventsAtOnce = 32;

/// A surface that a body was found to part from is left for this long at least, s: it must not be met again at once.
constexpr double kLeastLeaving = 1e-3;

constexpr double kNever = std::numeric_limits<double>::infinity();

struct Met {
    double time = kNever;
    std::size_t obstacle = 0;
    Surface surface;
};

/// Speed of parting below which a surface is not left any more but met: it rests there if it can.
double leastPartingSpeed(const Surroundings& around, const BodySlot& body, const Surface& surface, double t) {
    return canHold(surface, t, around.gravity, body.style)
               ? restSpeed(body.style, body.shape->length(), glm::length(around.gravity))
               : 0.0;
}

/// The first touch with one obstacle, as far as `to`.
std::optional<Touch> firstTouchOf(BodySlot& body, const ObstacleSlot& obstacle, ObstacleId id, double from, double to) {
    if (!obstacle.isPlane()) {
        return firstSolidTouch(body.phase, *body.shape, obstacle.shape, obstacle.frame, from, to, body.seeds.of(id));
    }
    const auto time = firstTouch(body.phase, *body.shape, obstacle.surface(), from, to);
    return time ? std::optional(Touch{*time, obstacle.surface()}) : std::nullopt;
}

/// The earliest touch within [from, to]; of equal ones that of the obstacle added first.
/// The obstacle being left is not looked at until it is left.
Met earliestTouch(const Surroundings& around, BodySlot& body, double from, double to) {
    const auto& flight = std::get<Flight>(body.phase.motion);
    Met met;
    thread_local std::vector<std::size_t> candidates;
    around.near(body.phase, *body.shape, from, to, candidates);
    for (const std::size_t i : candidates) {
        const ObstacleSlot& obstacle = around.obstacles[i];
        const ObstacleId id = idOfObstacle(i, obstacle);
        const bool left = flight.leaving_until > from && body.phase.obstacle == id;
        const double begin = left ? flight.leaving_until : from;
        const double end = std::min(to, met.time);
        if (begin > end) {
            continue;
        }
        const auto touch = firstTouchOf(body, obstacle, id, begin, end);
        if (touch && touch->time < met.time) {
            met = {touch->time, i, touch->surface};
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
                            .surface = met.surface};
    const std::optional<Impact> impact = beginImpact(touching, *body.shape, body.style);
    if (!impact) {
        // The plane that it touched, and no other: what parts from it now must not be found to meet it next.
        Left left{met.surface, idOfObstacle(met.obstacle, obstacle)};
        left.surface.solid = nullptr;
        left.parts = true;
        beginFlying(around, body, id, met.time, touching.pose, touching.velocity, Lead::Nearest, left, out);
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
        const Left left{impact.surface, phase.obstacle};
        beginFlying(around, body, id, t, pose, velocityAfter(impact, t), Lead::Nearest, left, out);
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

/// When the flight stops being pushed clear of the surface that it leaves, if it needs the push to the end: what it has
/// been pushed aside then becomes its way.
double leavingEndsPushed(const BodySlot& body) {
    const auto& flight = std::get<Flight>(body.phase.motion);
    const double until = flight.leaving_until;
    if (!(until >= body.phase.start && until < kNever)) {
        return kNever;
    }
    const Pose unpushed = unpushedPose(flight, until - body.phase.start);
    return gapTo(flight.leaving, *body.shape, unpushed, until) < 0.0 ? until : kNever;
}

} // namespace

void beginPhase(BodySlot& body, BodyId id, const Phase& phase, Happenings& out) {
    body.phase = phase;
    out.phases.push_back({id, body.phase});
}

void beginFlying(const Surroundings& around, BodySlot& body, BodyId id, double t, const Pose& pose,
                 const Vec3& velocity, Lead lead, const std::optional<Left>& left, Happenings& out) {
    Phase phase;
    phase.start = t;
    Flight flight = beginFlight(pose, velocity, around.gravity, body.style, lead);
    if (left) {
        const Surface plane = separatingPlane(left->surface, *body.shape, unpushedPose(flight, 0.0), t);
        double until = leavingUntil(plane, t, velocity, around.gravity, leastPartingSpeed(around, body, plane, t));
        if (left->parts) {
            until = std::max(until, t + kLeastLeaving);
        }
        if (until > t) {
            flight.leaving = plane;
            flight.leaving_until = until;
            phase.obstacle = left->obstacle;
        }
    }
    phase.motion = flight;
    beginPhase(body, id, phase, out);
}

void advanceBody(const Surroundings& around, BodySlot& body, BodyId id, double from, double to, Happenings& out) {
    double t = from;
    int stalled = 0;
    for (int i = 0; i < kMostEventsPerStep && stalled < kMostEventsAtOnce; ++i) {
        const double before = t;
        if (std::holds_alternative<Rest>(body.phase.motion)) {
            return;
        }
        if (std::holds_alternative<Impact>(body.phase.motion)) {
            if (body.phase.end > to) {
                return;
            }
            t = body.phase.end;
            endImpact(around, body, id, out);
            stalled = t > before ? 0 : stalled + 1;
            continue;
        }
        const double pushed_until = leavingEndsPushed(body);
        const Met met = earliestTouch(around, body, t, std::min(to, pushed_until));
        if (met.time < kNever) {
            t = met.time;
            meet(around, body, id, met, out);
        } else if (pushed_until <= to) {
            t = pushed_until;
            const Pose pose = poseAt(body.phase, *body.shape, t);
            beginFlying(around, body, id, t, pose, velocityAt(body.phase, *body.shape, t), Lead::Nearest, std::nullopt,
                        out);
        } else {
            return;
        }
        stalled = t > before ? 0 : stalled + 1;
    }
    const Pose pose = poseAt(body.phase, *body.shape, t);
    beginFlying(around, body, id, to, pose, velocityAt(body.phase, *body.shape, t), Lead::Nearest, std::nullopt, out);
}

} // namespace elastoon
