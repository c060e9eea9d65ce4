// See step.h: from event to event, phase to phase. Paper, section 3, the three steps of a time step.
#include "step.h"

#include "contact.h"
#include "push.h"
#include "touch.h"

#include <algorithm>
#include <optional>

namespace elastoon {

namespace {

/// More events than this in one step of one body, or more without any time between them: it is settled where it is.
constexpr int kMostEventsPerStep = 4096;
constexpr int kMostEventsAtOnce = 32;

constexpr double kNever = std::numeric_limits<double>::infinity();
/// No version of the surroundings.
constexpr std::uint64_t kLookedInVain = ~std::uint64_t{0};
/// At this share of its length from a body at rest an obstacle has come upon it.
constexpr double kHitGap = 1e-7;

/// The first touch with one obstacle, as far as `to`.
std::optional<Touch> firstTouchOf(BodySlot& body, const ObstacleSlot& obstacle, ObstacleId id, double from, double to) {
    if (!obstacle.isPlane()) {
        return firstSolidTouch(body.phase, *body.shape, obstacle.shape, obstacle.frame, from, to, body.seeds.of(id));
    }
    const auto time = firstTouch(body.phase, *body.shape, obstacle.surface(), from, to);
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
Met earliestTouch(const Surroundings& around, BodySlot& body, double from, double to) {
    Met met;
    thread_local std::vector<std::size_t> candidates;
    around.near(body.phase, *body.shape, from, to, candidates);
    for (const std::size_t i : candidates) {
        const ObstacleSlot& obstacle = around.obstacles[i];
        const ObstacleId id = idOfObstacle(i, obstacle);
        const double begin = std::max(from, clearUntil(body.phase, id));
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

/// The first other obstacle within [from, to] that a body held by one surface comes near to.
Met earliestNear(const Surroundings& around, const BodySlot& body, double from, double to) {
    Met met;
    const auto* rest = std::get_if<Rest>(&body.phase.motion);
    const bool stands = rest != nullptr && !rest->surface.frame.moves();
    if (stands && !around.anyMoves()) {
        return met;
    }
    const bool waits = std::holds_alternative<Impact>(body.phase.motion);
    const double gap = (waits ? kNearGap : kHitGap) * body.shape->length();
    thread_local std::vector<std::size_t> candidates;
    around.near(body.phase, *body.shape, from, to, candidates);
    for (const std::size_t i : candidates) {
        const ObstacleSlot& obstacle = around.obstacles[i];
        const ObstacleId id = idOfObstacle(i, obstacle);
        if (id == body.phase.obstacle || clearUntil(body.phase, id) > -kNever || (stands && !obstacle.frame.moves())) {
            continue;
        }
        const auto touch = firstNear(body.phase, *body.shape, obstacle.watched(), from, std::min(to, met.time), gap);
        if (touch && touch->time < met.time) {
            met = {touch->time, i, touch->surface};
        }
    }
    return met;
}

/// Looks well ahead of the step whether the body can touch anything at all, so that the next steps need not.
void lookAhead(const Surroundings& around, BodySlot& body, double from, double to) {
    constexpr double kStepsAhead = 32.0;
    if (around.anyMoves() || !body.phase.clear_of.empty()) {
        return;
    }
    const double until = from + kStepsAhead * (to - from);
    thread_local std::vector<std::size_t> candidates;
    around.near(body.phase, *body.shape, from, until, candidates);
    const bool misses = std::all_of(candidates.begin(), candidates.end(), [&](std::size_t i) {
        const ObstacleSlot& obstacle = around.obstacles[i];
        return obstacle.isPlane() && clearlyMisses(body.phase, *body.shape, obstacle.surface(), from, until);
    });
    // A failed look is not repeated at every step.
    body.untouched_until = misses ? until : from + 4.0 * (to - from);
    body.untouched_in = misses ? around.version : kLookedInVain;
}

/// When a flight stops being kept clear of a surface while it still needs it: what it has been pushed aside then
/// becomes its way.
double leavingEndsPushed(const BodySlot& body) {
    double first = kNever;
    for (const KeptClear& kept : body.phase.clear_of) {
        if (kept.until >= body.phase.start && kept.until < first) {
            const Pose unpushed = ownPose(body.phase, *body.shape, kept.until);
            first = gapTo(kept.surface, *body.shape, unpushed, kept.until) < 0.0 ? kept.until : first;
        }
    }
    return first;
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

/// The time of the body's next event within [from, to], done; kNever if there is none.
double nextEvent(const Surroundings& around, BodySlot& body, BodyId id, double from, double to, Happenings& out) {
    const auto at = [&](double t) { return Moment(around, body, id, t, out); };
    if (std::holds_alternative<Flight>(body.phase.motion)) {
        if (to <= body.untouched_until && body.untouched_in == around.version) {
            return kNever;
        }
        const double pushed_until = leavingEndsPushed(body);
        const Met met = earliestTouch(around, body, from, std::min(to, pushed_until));
        if (met.time < kNever) {
            at(met.time).touch(met);
            return met.time;
        }
        if (pushed_until <= to) {
            at(pushed_until).flyOn();
            return pushed_until;
        }
        if (to > body.untouched_until) {
            lookAhead(around, body, from, to);
        }
        return kNever;
    }
    const double end = body.phase.end;
    if (std::holds_alternative<Slide>(body.phase.motion)) {
        const Met met = earliestNear(around, body, from, std::min(to, end));
        if (met.time < kNever) {
            at(met.time).touchInSlide(met);
        } else if (end <= to) {
            at(end).endSlide();
        }
        return met.time < kNever ? met.time : end <= to ? end : kNever;
    }
    const bool impact = std::holds_alternative<Impact>(body.phase.motion);
    const Met met = earliestNear(around, body, from, std::min(to, end));
    if (met.time < kNever) {
        impact ? at(met.time).queue(met) : at(met.time).hitAtRest(met);
        return met.time;
    }
    const double let_go = impact ? kNever : pressLetsGo(body, from, std::min(to, end));
    if (let_go < kNever) {
        at(let_go).pressLetGo();
        return let_go;
    }
    if (end <= to) {
        impact ? at(end).endImpact() : at(end).wake();
        return end;
    }
    return kNever;
}

} // namespace

void advanceBody(const Surroundings& around, BodySlot& body, BodyId id, double from, double to, Happenings& out) {
    double t = from;
    int at_once = 0;
    for (int i = 0; i < kMostEventsPerStep && at_once < kMostEventsAtOnce; ++i) {
        const double next = nextEvent(around, body, id, t, to, out);
        if (next == kNever) {
            return;
        }
        at_once = next > t ? 0 : at_once + 1;
        t = std::max(t, next);
    }
    Moment(around, body, id, t, out).settle();
}

} // namespace elastoon
