// What the events of a body make of its phases. See step.h, class Moment. Paper, sections 3.4 to 3.6; docs/contacts.md.
#include "contact.h"
#include "impact.h"
#include "push.h"
#include "room.h"
#include "rotation.h"
#include "slide.h"
#include "step.h"

#include <algorithm>
#include <cmath>

namespace elastoon {

namespace {

/// A surface that a body was found to part from is left for this long at least, s: it must not be met again at once.
constexpr double kLeastLeaving = 1e-3;
/// Turns (rad) and stretches up to this are rounding.
constexpr double kSameForm = 1e-9;
/// Within this share of its length a waiting surface is touched.
constexpr double kTouched = 5e-7;

const ObstacleSlot* slotOf(const Surroundings& around, ObstacleId id) {
    const bool known = id.slot != 0 && id.slot <= around.obstacles.size();
    const ObstacleSlot* slot = known ? &around.obstacles[id.slot - 1] : nullptr;
    return slot != nullptr && slot->used && slot->generation == id.generation ? slot : nullptr;
}

/// More than rounding.
bool differs(const Pose& a, const Pose& b) {
    const Quat turn = glm::conjugate(a.orientation) * b.orientation;
    const double sine = std::sqrt(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);
    return sine > kSameForm || std::fabs(a.stretch - b.stretch) > kSameForm;
}

} // namespace

/// Speed of parting below which a surface is not left any more but met: it rests there if it can.
double Moment::leastPartingSpeed(const Surface& surface) const {
    return canHold(surface, t_, around_.gravity, body_.style)
               ? restSpeed(body_.style, body_.shape->length(), glm::length(around_.gravity))
               : 0.0;
}

void Moment::begin(Phase phase) {
    if (phase.is<Flight>() && !phase.clear_of.empty()) {
        findFreeFrom(phase, *body_.shape);
    }
    body_.phase = std::move(phase);
    body_.plan = {};
    body_.plan.version = around_.version;
    out_.phases.push_back({id_, body_.phase});
}

void Moment::note(EventType type, ObstacleId other, const Surface& surface, double speed, const ImpactCurve& curve) {
    out_.events.push_back({.time = t_,
                           .type = type,
                           .body = id_,
                           .other = other,
                           .point = surface.pointAt(t_),
                           .normal = surface.normalAt(t_),
                           .speed = speed,
                           .s_in = curve.s_in,
                           .s_mid = curve.s_mid,
                           .s_out = curve.s_out,
                           .t_in = curve.t_in,
                           .t_out = curve.t_out});
}

std::vector<Left> Moment::held() const {
    std::vector<Left> held;
    if (const Surface* surface = surfaceOf(body_.phase)) {
        held.push_back({*surface, body_.phase.obstacle});
    }
    for (const KeptClear& kept : body_.phase.clear_of) {
        if (kept.until >= t_) {
            held.push_back({kept.surface, kept.obstacle});
        }
    }
    return held;
}

void Moment::fly(const Pose& pose, const Vec3& velocity, Lead lead, std::span<const Left> lefts, double ease) {
    Phase phase;
    phase.start = t_;
    Flight flight = beginFlight(pose, velocity, around_.gravity, body_.style, lead);
    if (ease > 0.0 && differs(pose, unpushedPose(flight, 0.0))) {
        easeFrom(flight, pose, ease);
    }
    const Pose first = unpushedPose(flight, 0.0);
    for (const Left& left : lefts) {
        const Surface plane =
            left.surface.solid ? separatingPlane(left.surface, *body_.shape, first, t_) : left.surface;
        double until = std::min(leavingUntil(plane, t_, flight, *body_.shape, leastPartingSpeed(plane)),
                                outOfReach(left.surface, t_, flight, *body_.shape));
        if (left.parts) {
            until = std::max({until, t_ + kLeastLeaving, t_ + left.for_at_least});
        }
        if (until > t_) {
            phase.clear_of.push_back({plane, left.obstacle, t_, until});
            phase.obstacle = phase.clear_of.size() == 1 ? left.obstacle : phase.obstacle;
        }
    }
    phase.motion = flight;
    begin(std::move(phase));
}

void Moment::flyOn() {
    std::vector<Left> lefts;
    for (const KeptClear& kept : body_.phase.clear_of) {
        if (kept.until > t_) {
            lefts.push_back({kept.surface, kept.obstacle});
        }
    }
    fly(pose(), velocity(), Lead::Nearest, lefts, settlingTime(body_.style, body_.shape->length()));
}

Touching Moment::touchingOf(const Met& met, const Pose& pose, const Vec3& velocity,
                            std::span<const KeptClear> waiting) const {
    Touching touching{.time = t_,
                      .pose = pose,
                      .velocity = velocity,
                      .gravity = around_.gravity,
                      .surface = met.surface,
                      .besides = {}};
    for (const KeptClear& kept : waiting) {
        if (gapTo(kept.surface, *body_.shape, pose, t_) <= kTouched * body_.shape->length()) {
            touching.besides.push_back(kept.surface.normalAt(t_));
        }
    }
    return touching;
}

/// False where the touch begins no slide.
bool Moment::beginSlideOn(const Met& met, const Pose& pose, const Vec3& velocity, bool goes_on,
                          std::span<const KeptClear> waiting) {
    const Touching touching = touchingOf(met, pose, velocity, waiting);
    const std::optional<SlideBegun> begun = beginSlide(touching, *body_.shape, body_.style);
    if (!begun) {
        return false;
    }
    Phase phase;
    phase.start = t_;
    phase.end = t_ + begun->duration;
    phase.obstacle = idOfObstacle(met.obstacle, around_.obstacles[met.obstacle]);
    phase.motion = begun->slide;
    if (!goes_on) {
        ImpactCurve none;
        none.s_in = none.s_mid = none.s_out = pose.stretch;
        Surface surface = met.surface;
        surface.point = surface.frame.frameFromWorld(t_, contactPoint(*body_.shape, pose, surface, t_));
        note(EventType::Impact, phase.obstacle, surface, glm::length(velocity - surface.frame.velocity), none);
    }
    begin(std::move(phase));
    return true;
}

void Moment::endSlide() {
    const Phase phase = body_.phase;
    const auto& slide = phase.get<Slide>();
    const ObstacleSlot* obstacle = slotOf(around_, phase.obstacle);
    const Pose pose = this->pose();
    const Vec3 velocity = this->velocity();
    const double elapsed = t_ - slide.begun;
    const Vec3 along = slideVelocity(slide, t_);
    const Vec3 foot = slide.foot + (slide.velocity + slide.acceleration * (0.5 * elapsed)) * elapsed;
    const double speed = glm::length(along);
    constexpr double kMomentOnFace = 1e-6;
    const bool on_face = timeOnFace(slide.surface, foot, along, slide.acceleration) > kMomentOnFace;
    if (obstacle != nullptr && on_face) {
        const Met again{t_, phase.obstacle.slot - 1, slide.surface};
        if (beginSlideOn(again, pose, velocity, true, phase.clear_of) ||
            beginImpactWith(again, pose, velocity, phase.clear_of)) {
            return;
        }
    }
    // What hangs over the edge draws the rest after it; until then the edge bears it.
    constexpr double kLongestOverEdge = 0.3;
    const double reach =
        reachTowards(*body_.shape, pose, speed > 0.0 ? slide.surface.frame.orientation * (along / speed) : Vec3(0.0));
    Left left{slide.surface, phase.obstacle, true,
              std::min(kLongestOverEdge, speed > 0.0 ? reach / speed : kLongestOverEdge)};
    Surface last = slide.surface;
    last.point = last.frame.frameFromWorld(t_, contactPoint(*body_.shape, pose, slide.surface, t_));
    note(EventType::Release, phase.obstacle, last, speed, ImpactCurve{});
    fly(pose, velocity, Lead::Nearest, {&left, 1}, settlingTime(body_.style, body_.shape->length()));
}

void Moment::touchInSlide(const Met& met) {
    const auto& slide = body_.phase.get<Slide>();
    const ObstacleId id = idOfObstacle(met.obstacle, around_.obstacles[met.obstacle]);
    const Surface under =
        slide.surface.solid ? separatingPlane(slide.surface, *body_.shape, pose(), t_) : slide.surface;
    Met solid = met;
    solid.surface.solid = around_.obstacles[met.obstacle].shape;
    if (beginImpactWith(solid, pose(), velocity(), {{under, body_.phase.obstacle, t_}})) {
        return;
    }
    Phase phase = body_.phase;
    phase.start = t_;
    phase.clear_of.push_back({met.surface, id, t_});
    begin(std::move(phase));
}

/// False where the body is parting from the surface and not slow.
bool Moment::beginImpactWith(const Met& met, const Pose& pose, const Vec3& velocity, std::vector<KeptClear> waiting) {
    if (beginSlideOn(met, pose, velocity, false, waiting)) {
        return true;
    }
    const ObstacleSlot& obstacle = around_.obstacles[met.obstacle];
    const Touching touching = touchingOf(met, pose, velocity, waiting);
    const std::optional<Impact> impact = beginImpact(touching, *body_.shape, body_.style);
    if (!impact) {
        return false;
    }
    Phase phase;
    phase.start = t_;
    phase.end = t_ + impact->curve.duration();
    if (impact->skims != Vec3(0.0)) {
        phase.end =
            std::min(phase.end, t_ + timeOnFace(impact->surface, impact->surface.point, impact->skims, Vec3(0.0)));
    }
    phase.obstacle = idOfObstacle(met.obstacle, obstacle);
    phase.motion = *impact;
    phase.clear_of = std::move(waiting);
    for (KeptClear& kept : phase.clear_of) {
        const bool presses = opposes(impact->surface.normalAt(t_), kept.surface.normalAt(t_));
        if (presses && !kept.presses) {
            note(EventType::Squeeze, kept.obstacle, kept.surface, 0.0, impact->curve);
        }
        kept.presses = presses;
    }
    if (!phase.clear_of.empty()) {
        phase.end = blockedAt(phase, *body_.shape);
    }
    const Vec3 contact = impact->surface.pointAt(t_);
    const double speed = glm::length(velocity - obstacle.frame.velocityAt(t_, contact));
    note(EventType::Impact, phase.obstacle, impact->surface, speed, impact->curve);
    begin(std::move(phase));
    return true;
}

void Moment::touch(const Met& met) {
    const Pose pose = this->pose();
    const Vec3 velocity = this->velocity();
    if (beginImpactWith(met, pose, velocity, {})) {
        return;
    }
    // The plane that it touched, and no other: what parts from it now must not be found to meet it next.
    const ObstacleId id = idOfObstacle(met.obstacle, around_.obstacles[met.obstacle]);
    std::vector<Left> lefts{{met.surface, id, true}};
    lefts.front().surface.solid = nullptr;
    for (const KeptClear& kept : body_.phase.clear_of) {
        if (kept.until > t_ && kept.obstacle != id) {
            lefts.push_back({kept.surface, kept.obstacle});
        }
    }
    // What it brushes it leaves, without a phase.
    const Vec3 normal = met.surface.normalAt(t_);
    const Vec3 carried = met.surface.frame.velocityAt(t_, met.surface.pointAt(t_));
    const double parting = glm::dot(velocity - carried, normal);
    const Vec3 away = velocity - normal * ((1.0 + body_.style->restitution) * std::min(0.0, parting));
    fly(pose, away, Lead::Nearest, lefts, settlingTime(body_.style, body_.shape->length()));
}

void Moment::queue(const Met& met) {
    Phase phase = body_.phase;
    phase.start = t_;
    const ObstacleId id = idOfObstacle(met.obstacle, around_.obstacles[met.obstacle]);
    const auto& impact = phase.get<Impact>();
    const bool presses = opposes(impact.surface.normalAt(t_), met.surface.normalAt(t_));
    phase.clear_of.push_back({.surface = met.surface, .obstacle = id, .since = t_, .presses = presses});
    if (presses) {
        note(EventType::Squeeze, id, met.surface, 0.0, impact.curve);
    }
    if (body_.style->corner_rule == CornerRule::Blended) {
        blend(phase);
    }
    phase.end = blockedAt(phase, *body_.shape);
    begin(std::move(phase));
}

/// While the body still squashes, all that it touches throws it back.
void Moment::blend(Phase& phase) const {
    Impact& impact = phase.edit<Impact>();
    if (impact.comes_to_rest || t_ - impact.begun > impact.curve.t_in) {
        return;
    }
    const MovingFrame& frame = impact.surface.frame;
    const Quat frame_from_world = glm::conjugate(frame.orientationAt(t_));
    std::vector<AlsoTouched> others;
    for (const KeptClear& kept : phase.clear_of) {
        const Vec3 point = kept.surface.pointAt(t_);
        others.push_back({frame_from_world * kept.surface.normalAt(t_),
                          frame_from_world * (kept.surface.frame.velocityAt(t_, point) - frame.velocityAt(t_, point))});
    }
    impact = blendImpact(impact, t_, others, *body_.shape, body_.style, around_.gravity);
    phase.end = impact.begun + impact.curve.duration();
}

/// Of what waits: what closes on the body from the other side.
std::vector<KeptClear> Moment::pressingOn(const Surface& surface) const {
    std::vector<KeptClear> pressing;
    const Vec3 normal = surface.normalAt(t_);
    for (const KeptClear& kept : body_.phase.clear_of) {
        const Vec3 other = kept.surface.normalAt(t_);
        const Vec3 point = kept.surface.pointAt(t_);
        const Vec3 closing = kept.surface.frame.velocityAt(t_, point) - surface.frame.velocityAt(t_, point);
        if (opposes(normal, other) && glm::dot(closing, other) > 0.0) {
            pressing.push_back(kept);
            pressing.back().presses = true;
        }
    }
    return pressing;
}

/// The first of those that wait, still touched and still approached, is met. Paper, section 3.6.
bool Moment::meetNextWaiting(const Impact& impact) {
    const Phase& phase = body_.phase;
    if (phase.clear_of.empty()) {
        return false;
    }
    const Pose pose = this->pose();
    const Vec3 velocity = velocityAfter(impact, t_);
    for (std::size_t i = 0; i < phase.clear_of.size(); ++i) {
        const KeptClear& next = phase.clear_of[i];
        const ObstacleSlot* obstacle = slotOf(around_, next.obstacle);
        if (obstacle == nullptr) {
            continue;
        }
        ClosestSeed cold;
        Distance distance = distanceTo(obstacle->watched(), *body_.shape, pose, t_, cold);
        const Vec3 normal = distance.plane.normalAt(t_);
        const Vec3 carried = obstacle->frame.velocityAt(t_, distance.plane.pointAt(t_));
        if (distance.gap > kTouched * body_.shape->length() || glm::dot(velocity - carried, normal) >= 0.0) {
            continue;
        }
        std::vector<KeptClear> waiting;
        Surface left = impact.surface.solid ? separatingPlane(impact.surface, *body_.shape, pose, t_) : impact.surface;
        waiting.push_back({left, phase.obstacle, t_});
        for (std::size_t k = 0; k < phase.clear_of.size(); ++k) {
            if (k != i) {
                waiting.push_back(phase.clear_of[k]);
            }
        }
        distance.plane.solid = obstacle->shape;
        if (beginImpactWith({t_, next.obstacle.slot - 1, distance.plane}, pose, velocity, std::move(waiting))) {
            return true;
        }
    }
    return false;
}

void Moment::restOn(const Impact& impact, const std::vector<KeptClear>& pressing) {
    const Pose pose = this->pose();
    const MovingFrame& frame = impact.surface.frame;
    Rest rest;
    rest.surface = impact.surface;
    rest.pose.position = frame.frameFromWorld(t_, pose.position);
    rest.pose.orientation = glm::conjugate(frame.orientationAt(t_)) * pose.orientation;
    // A pressed body begins as it is pressed; let go, it comes back to its form.
    rest.pose.stretch = pressing.empty() ? 1.0 : pose.stretch;
    Phase next;
    next.start = t_;
    // Where only the press holds it, the press's going wakes it.
    const double end = holdsUntil(rest.surface, t_, around_.gravity, body_.style);
    next.end = end >= t_ ? end : std::numeric_limits<double>::infinity();
    next.obstacle = body_.phase.obstacle;
    next.clear_of = pressing;
    next.motion = rest;
    note(EventType::Rest, next.obstacle, impact.surface, glm::length(impact.velocity_out), impact.curve);
    begin(std::move(next));
}

void Moment::steer(const Vec3& velocity) {
    Phase phase = body_.phase;
    Impact& impact = phase.edit<Impact>();
    const bool ends_itself = phase.end == impact.begun + impact.curve.duration();
    impact = steeredImpact(impact, t_, velocity, *body_.shape, body_.style, around_.gravity);
    phase.start = t_;
    // Where something else ends it, that is looked for again, from now on.
    const double whole = impact.begun + impact.curve.duration();
    phase.end = ends_itself ? whole : std::min(phase.end, whole);
    if (!phase.clear_of.empty()) {
        phase.end = std::max(t_, std::min(phase.end, blockedAt(phase, *body_.shape)));
    }
    begin(std::move(phase));
}

void Moment::endImpact() {
    const Phase& phase = body_.phase;
    const auto& impact = phase.get<Impact>();
    const std::vector<KeptClear> pressing = pressingOn(impact.surface);
    // One that found no room to go on has not come to its resting form.
    const bool whole = impact.comes_to_rest && t_ >= impact.begun + impact.curve.duration() &&
                       std::fabs(pose().stretch - impact.curve.s_out) < kSameForm;
    if (whole && !canHold(impact.surface, t_, around_.gravity, body_.style)) {
        restOn(impact, phase.clear_of);
        return;
    }
    if (whole || !pressing.empty()) {
        restOn(impact, pressing);
        return;
    }
    note(EventType::Release, phase.obstacle, impact.surface, glm::length(impact.velocity_out), impact.curve);
    if (!meetNextWaiting(impact)) {
        fly(pose(), velocityAfter(impact, t_), Lead::Nearest, held(), settlingTime(body_.style, body_.shape->length()));
    }
}

void Moment::hitAtRest(const Met& met) {
    const auto& rest = body_.phase.get<Rest>();
    const ObstacleId id = idOfObstacle(met.obstacle, around_.obstacles[met.obstacle]);
    const Surface support = rest.surface;
    const ObstacleId held_by = body_.phase.obstacle;
    const bool presses = opposes(support.normalAt(t_), met.surface.normalAt(t_));
    // Under a press there is nowhere to be thrown to.
    if (!presses && !isPressed(body_.phase, t_)) {
        const Surface plane = support.solid ? separatingPlane(support, *body_.shape, pose(), t_) : support;
        Surface surface = met.surface;
        surface.solid = around_.obstacles[met.obstacle].shape;
        const Vec3 before = velocity();
        if (beginImpactWith({t_, met.obstacle, surface}, pose(), before, {{plane, held_by, t_}})) {
            return;
        }
    }
    Phase phase = body_.phase;
    phase.start = t_;
    phase.clear_of.push_back({.surface = met.surface, .obstacle = id, .since = t_, .presses = presses});
    if (presses) {
        note(EventType::Squeeze, id, met.surface, 0.0, ImpactCurve{});
    }
    begin(std::move(phase));
}

void Moment::pressLetGo() {
    Phase phase = body_.phase;
    phase.start = t_;
    phase.clear_of.clear();
    const Rest rest = phase.get<Rest>();
    begin(std::move(phase));
    if (!canHold(rest.surface, t_, around_.gravity, body_.style)) {
        wake();
    } else if (rest.pose.stretch != 1.0) {
        recover();
    }
}

void Moment::recover() {
    const Pose squeezed = pose();
    const Rest rest = body_.phase.get<Rest>();
    Phase phase = body_.phase;
    Impact impact;
    impact.begun = phase.start = t_;
    impact.surface = rest.surface;
    const Quat world_from_frame = rest.surface.frame.orientationAt(t_);
    impact.orientation = unitOf(glm::conjugate(world_from_frame) * squeezed.orientation);
    const Vec3 contact = contactPoint(*body_.shape, squeezed, rest.surface, t_);
    impact.surface.point = rest.surface.frame.frameFromWorld(t_, contact);
    impact.contact_in_shape =
        (glm::conjugate(squeezed.orientation) * (contact - squeezed.position)) / scaleOf(squeezed.stretch);
    impact.curve = recoveryCurve(body_.style, body_.shape->length(), squeezed.stretch);
    impact.comes_to_rest = true;
    phase.end = t_ + impact.curve.duration();
    phase.clear_of.clear();
    phase.motion = impact;
    begin(std::move(phase));
}

void Moment::wake(std::span<const Left> lefts, const Vec3& velocity) {
    if (const auto* rest = body_.phase.as<Rest>()) {
        note(EventType::Wake, body_.phase.obstacle, rest->surface, 0.0, ImpactCurve{});
    }
    const Pose pose = this->pose();
    fly(pose, velocity, Lead::Nearest, lefts, settlingTime(body_.style, body_.shape->length()));
}

void Moment::settle() {
    const std::vector<Left> held = this->held();
    if (held.empty()) {
        flyOn();
        return;
    }
    const Left& on = held.front();
    const Pose pose = this->pose();
    Rest rest;
    rest.surface = on.surface;
    rest.pose.position = on.surface.frame.frameFromWorld(t_, pose.position);
    rest.pose.orientation = glm::conjugate(on.surface.frame.orientationAt(t_)) * pose.orientation;
    rest.pose.stretch = pose.stretch;
    Phase phase;
    phase.start = t_;
    phase.obstacle = on.obstacle;
    phase.motion = rest;
    note(EventType::Squeeze, on.obstacle, on.surface, 0.0, ImpactCurve{});
    begin(std::move(phase));
}

} // namespace elastoon
