// See step.h: from event to event, phase to phase. Paper, section 3, the three steps of a time step.
#include "step.h"

#include "contact.h"
#include "push.h"
#include "room.h"
#include "squeeze.h"
#include "touch.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace elastoon {

namespace {

/// More events than this in one step of one body, or more without any time between them: it is settled where it is.
constexpr int kMostEventsPerStep = 4096;
constexpr int kMostEventsAtOnce = 32;

constexpr double kNever = std::numeric_limits<double>::infinity();
/// At this share of its length from a body at rest an obstacle has come upon it.
constexpr double kHitGap = 1e-7;

/// The first touch with one obstacle, as far as `to`. Each search begins cold: a seed kept from an earlier one would
/// let what was looked at before show in the last bit.
std::optional<Touch> firstTouchOf(const BodySlot& body, const ObstacleSlot& obstacle, double from, double to,
                                  double give_up) {
    if (!obstacle.isPlane()) {
        ClosestSeed cold;
        return firstSolidTouch(body.phase, *body.shape, obstacle.shape, obstacle.frame, from, to, cold, give_up);
    }
    const auto time = firstTouch(body.phase, *body.shape, obstacle.surface(), from, to, give_up);
    return time ? std::optional(Touch{*time, obstacle.surface()}) : std::nullopt;
}

/// Until when the body is kept clear of the obstacle.
double clearUntil(const Phase& phase, ObstacleId id) {
    double until = -kNever;
    for (const KeptClear& kept : phase.clear_of) {
        until = kept.obstacle == id ? std::max(until, kept.until) : until;
    }
    return until;
}

/// The earliest touch of a flight within [from, to]; of equal ones that of the obstacle added first.
/// An obstacle being left is not looked at until it is left.
Met earliestTouch(const Surroundings& around, const BodySlot& body, double from, double to) {
    Met met;
    thread_local std::vector<std::size_t> candidates;
    around.near(body.phase, *body.shape, from, to, candidates);
    for (const std::size_t i : candidates) {
        const ObstacleSlot& obstacle = around.obstacles[i];
        const ObstacleId id = idOfObstacle(i, obstacle);
        // Before it began to move as it does, it was met or missed otherwise.
        const double begin = std::max({from, clearUntil(body.phase, id), obstacle.frame.start});
        if (begin > std::min(to, met.time)) {
            continue;
        }
        const auto touch = firstTouchOf(body, obstacle, begin, to, met.time);
        if (touch && touch->time < met.time) {
            met = {touch->time, i, touch->surface};
        }
    }
    return met;
}

/// The first other obstacle within [from, to] that a body held by one surface comes near to.
Met earliestNear(const Surroundings& around, const BodySlot& body, double from, double to) {
    Met met;
    const auto* rest = body.phase.as<Rest>();
    const bool stands = rest != nullptr && !rest->surface.frame.moves();
    if (stands && !around.anyMoves()) {
        return met;
    }
    const bool waits = body.phase.is<Impact>();
    const double gap = (waits ? kNearGap : kHitGap) * body.shape->length();
    thread_local std::vector<std::size_t> candidates;
    around.near(body.phase, *body.shape, from, to, candidates);
    thread_local std::vector<Watched> watched;
    thread_local std::vector<std::size_t> slots;
    watched.clear();
    slots.clear();
    for (const std::size_t i : candidates) {
        const ObstacleSlot& obstacle = around.obstacles[i];
        const ObstacleId id = idOfObstacle(i, obstacle);
        if (id != body.phase.obstacle && clearUntil(body.phase, id) == -kNever && (!stands || obstacle.frame.moves())) {
            watched.push_back(obstacle.watched());
            slots.push_back(i);
        }
    }
    if (const auto near = firstNear(body.phase, *body.shape, watched, from, to, gap)) {
        met = {near->touch.time, slots[static_cast<std::size_t>(near->watched - watched.data())], near->touch.surface};
    }
    return met;
}

/// When a flight stops being kept clear of a surface while it still needs it: what it has been pushed aside then
/// becomes its way.
double leavingEndsPushed(const BodySlot& body, double from) {
    double first = kNever;
    for (const KeptClear& kept : body.phase.clear_of) {
        const bool counts = kept.until >= from && kept.until < body.phase.free_from;
        if (counts && kept.until < first) {
            const Pose unpushed = ownPose(body.phase, *body.shape, kept.until);
            first = gapTo(kept.surface, *body.shape, unpushed, kept.until) < 0.0 ? kept.until : first;
        }
    }
    return first;
}

/// When, within [from, to], what moves leaves a body at rest no room beside what else holds it. What presses it alone
/// flattens it instead.
double leftWithoutRoom(const BodySlot& body, double from, double to) {
    const auto& clear_of = body.phase.clear_of;
    const auto& rest = body.phase.get<Rest>();
    const bool moves =
        rest.surface.frame.moves() ||
        std::any_of(clear_of.begin(), clear_of.end(), [](const KeptClear& kept) { return kept.surface.frame.moves(); });
    const bool only_pressed =
        std::all_of(clear_of.begin(), clear_of.end(), [](const KeptClear& kept) { return kept.presses; });
    if (!moves || only_pressed || from >= to ||
        (isPressed(body.phase, from) && !fitsUnderPress(body.phase, *body.shape, from))) {
        return kNever;
    }
    const double blocked = blockedAt(body.phase, *body.shape, from, to);
    return blocked < to ? blocked : kNever;
}

/// When, within [from, to], nothing that a body at rest is kept clear of touches it any more.
double pressLetsGo(const BodySlot& body, double from, double to) {
    if (body.phase.clear_of.empty()) {
        return kNever;
    }
    const auto isFree = [&](double t) {
        const Pose own = ownPose(body.phase, *body.shape, t);
        return std::all_of(body.phase.clear_of.begin(), body.phase.clear_of.end(), [&](const KeptClear& kept) {
            return gapTo(kept.surface, *body.shape, own, t) > 2.0 * kHitGap * body.shape->length();
        });
    };
    if (!isFree(to)) {
        return kNever;
    }
    double held = from;
    double free = to;
    while (held < free) {
        const double middle = held + 0.5 * (free - held);
        if (middle <= held || middle >= free) {
            break;
        }
        (isFree(middle) ? free : held) = middle;
    }
    return free;
}

/// What comes next within [from, to]; its time is kNever if that is nothing.
Plan nextEvent(const Surroundings& around, const BodySlot& body, double from, double to) {
    Plan plan;
    const auto meet = [&](const Met& met) {
        if (met.time < kNever) {
            plan.meet(met, around.obstacles[met.obstacle]);
        }
        return plan.meets();
    };
    const auto otherwise = [&](double time, Plan::Kind kind) {
        plan.time = time <= to ? time : kNever;
        plan.kind = kind;
        return plan;
    };
    if (body.phase.is<Flight>()) {
        const double pushed_until = leavingEndsPushed(body, from);
        return meet(earliestTouch(around, body, from, std::min(to, pushed_until)))
                   ? plan
                   : otherwise(pushed_until, Plan::Kind::FlyOn);
    }
    double end = body.phase.end;
    if (body.phase.is<Rest>()) {
        end = std::min(end, leftWithoutRoom(body, from, std::min(to, end)));
    }
    if (meet(earliestNear(around, body, from, std::min(to, end)))) {
        return plan;
    }
    if (body.phase.is<Slide>()) {
        return otherwise(end, Plan::Kind::EndSlide);
    }
    if (body.phase.is<Impact>()) {
        return otherwise(end, Plan::Kind::EndImpact);
    }
    const double let_go = pressLetsGo(body, from, std::min(to, end));
    return let_go < kNever ? otherwise(let_go, Plan::Kind::PressLetGo) : otherwise(end, Plan::Kind::Wake);
}

/// Looks ahead of the step, so that what comes is looked up once. How far it looks and from where depends on the phase
/// alone, also where the surroundings have changed meanwhile: neither the step nor what is unrelated shows, not even in
/// the last bit.
void planAhead(const Surroundings& around, BodySlot& body, double from) {
    constexpr double kAhead = Surroundings::kAhead;
    const double start = body.phase.start;
    const bool goes_on = body.plan.version == around.version && body.plan.looked_until > -kNever;
    const double window = goes_on ? body.plan.window + 1.0 : std::floor((from - start) / kAhead);
    const double begin = start + window * kAhead;
    double ahead = start + (window + 1.0) * kAhead;
    const auto* rest = body.phase.as<Rest>();
    if (rest != nullptr && !rest->surface.frame.moves() && !around.anyMoves() && body.phase.clear_of.empty()) {
        ahead = kNever;
    }
    // What was left long ago, and an ease that is over, take no more room.
    if (!body.phase.clear_of.empty() && hasLeftAll(body.phase, begin)) {
        std::vector<KeptClear>().swap(body.phase.clear_of);
    }
    const auto* flight = body.phase.as<Flight>();
    if (flight != nullptr && !flight->ease.isUsual() && begin >= start + flight->ease->span) {
        body.phase.edit<Flight>().ease = {};
    }
    body.plan = nextEvent(around, body, begin, ahead);
    if (body.plan.time < from) {
        // What has come since was not there then.
        body.plan = nextEvent(around, body, from, std::max(ahead, from));
    }
    body.plan.window = window;
    body.plan.looked_until = ahead;
    body.plan.version = around.version;
}

void carryOutMeeting(const Met& met, const BodySlot& body, Moment& moment) {
    if (body.phase.is<Flight>()) {
        moment.touch(met);
    } else if (body.phase.is<Slide>()) {
        moment.touchInSlide(met);
    } else if (body.phase.is<Impact>()) {
        moment.queue(met);
    } else {
        moment.hitAtRest(met);
    }
}

void carryOut(const Plan& plan, const Surroundings& around, const BodySlot& body, Moment moment) {
    switch (plan.kind) {
    case Plan::Kind::Meet:
        carryOutMeeting(metOf(plan, around), body, moment);
        break;
    case Plan::Kind::FlyOn:
        moment.flyOn();
        break;
    case Plan::Kind::EndSlide:
        moment.endSlide();
        break;
    case Plan::Kind::EndImpact:
        moment.endImpact();
        break;
    case Plan::Kind::PressLetGo:
        moment.pressLetGo();
        break;
    case Plan::Kind::Wake:
        moment.wake();
        break;
    }
}

} // namespace

void Plan::meet(const Met& met, const ObstacleSlot& slot) {
    kind = Kind::Meet;
    time = met.time;
    obstacle = static_cast<std::uint32_t>(met.obstacle);
    on_solid = met.surface.solid != nullptr;
    place = slot.isPlane() ? Boxed<Place>() : Place{met.surface.point, met.surface.normal};
}

Met metOf(const Plan& plan, const Surroundings& around) {
    const ObstacleSlot& obstacle = around.obstacles[plan.obstacle];
    if (obstacle.isPlane()) {
        return {plan.time, plan.obstacle, obstacle.surface()};
    }
    const Surface surface{obstacle.frame, plan.place->point, plan.place->normal,
                          plan.on_solid ? obstacle.shape : nullptr};
    return {plan.time, plan.obstacle, surface};
}

double advanceBody(const Surroundings& around, BodySlot& body, BodyId id, double from, double to, Happenings& out) {
    double t = from;
    int at_once = 0;
    int events = 0;
    while (events < kMostEventsPerStep && at_once < kMostEventsAtOnce) {
        if (body.plan.version == around.version && body.plan.time > to && to <= body.plan.looked_until) {
            return std::min(body.plan.looked_until, body.plan.time);
        }
        if (body.plan.version != around.version || body.plan.time > to) {
            planAhead(around, body, t);
            continue;
        }
        // What it carries out begins a phase, which has no plan yet.
        const Plan plan = std::exchange(body.plan, {});
        ++events;
        at_once = plan.time > t ? 0 : at_once + 1;
        t = std::max(t, plan.time);
        carryOut(plan, around, body, Moment(around, body, id, t, out));
    }
    Moment(around, body, id, t, out).settle();
    return to;
}

} // namespace elastoon
