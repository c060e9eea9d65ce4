// What users may change in a world between steps, and what becomes of the bodies. See world.h, docs/contacts.md.
#include "check_input.h"
#include "impact.h"
#include "push.h"
#include "rotation.h"
#include "touch.h"
#include "world_impl.h"

#include <algorithm>
#include <optional>

namespace elastoon {

/// The obstacle is gone: what it held flies on, and nothing is kept clear of it.
void World::Impl::letGo(BodyId id, ObstacleId obstacle) {
    BodySlot& body = *find(id);
    const bool held = body.phase.obstacle == obstacle && !body.phase.is<Flight>();
    const auto isOfIt = [&](const KeptClear& kept) { return kept.obstacle == obstacle; };
    const bool near =
        !hasLeftAll(body.phase, time) && std::any_of(body.phase.clear_of.begin(), body.phase.clear_of.end(), isOfIt);
    if (held) {
        std::vector<Left> lefts = now(id).held();
        std::erase_if(lefts, [&](const Left& left) { return left.obstacle == obstacle; });
        now(id).wake(lefts);
    } else if (near && body.phase.is<Rest>()) {
        now(id).recover();
    } else if (near) {
        // The push goes on as it was, or the body would jump; but it may meet the obstacle elsewhere.
        Phase phase = whole(id.slot - 1).phase;
        for (KeptClear& kept : phase.clear_of) {
            kept.obstacle = isOfIt(kept) ? ObstacleId{} : kept.obstacle;
        }
        if (phase.is<Flight>()) {
            body.phase = phase;
            now(id).flyOn();
        } else {
            phase.start = time;
            now(id).begin(phase);
        }
    }
}

/// The body flies on from its present pose; the stretch and axis become those of the velocity: at once if there is
/// room, else by and by.
void World::Impl::fly(BodyId id, const Vec3& velocity, const std::vector<Left>& lefts) {
    const BodySlot& body = whole(id.slot - 1);
    const Pose pose = poseAt(body.phase, *body.shape, time);
    now(id).fly(pose, velocity, Lead::Nearest, lefts);
    if (overlap(*body.shape, poseAt(body.phase, *body.shape, time))) {
        pending.phases.pop_back();
        now(id).fly(pose, velocity, Lead::Nearest, lefts, settlingTime(body.style, body.shape->length()));
    }
}

Status World::setPosition(BodyId id, const Vec3& position) {
    BodySlot* body = impl_->find(id);
    if (body == nullptr) {
        return kUnknownBody;
    }
    if (auto error = checkVector(position, kMostPosition, "position")) {
        return *error;
    }
    const Vec3 velocity = impl_->velocityIn(id.slot - 1);
    Pose pose = impl_->poseIn(id.slot - 1);
    pose.position = position;
    const Flight flight = beginFlight(pose, velocity, impl_->around.gravity, body->style, Lead::Nearest);
    if (const auto overlap = impl_->overlap(*body->shape, unpushedPose(flight, 0.0))) {
        return overlapError(*overlap);
    }
    impl_->now(id).fly(pose, velocity, Lead::Nearest);
    return success();
}

Status World::setVelocity(BodyId id, const Vec3& velocity) {
    if (!contains(id)) {
        return kUnknownBody;
    }
    if (auto error = checkVector(velocity, kMostSpeed, "velocity")) {
        return *error;
    }
    impl_->fly(id, velocity, impl_->now(id).held());
    return success();
}

Status World::steerImpact(BodyId id, const Vec3& velocity) {
    const BodySlot* body = impl_->find(id);
    if (body == nullptr) {
        return kUnknownBody;
    }
    if (auto error = checkVector(velocity, kMostSpeed, "velocity")) {
        return *error;
    }
    const auto* impact = body->phase.as<Impact>();
    if (impact == nullptr) {
        return Error{"the body must be in an impact, is in a " + std::string(nameOf(body->phase)), "id"};
    }
    const Surface& surface = impact->surface;
    const Vec3 relative = velocity - surface.frame.velocityAt(impl_->time, surface.pointAt(impl_->time));
    if (!(glm::dot(relative, surface.normalAt(impl_->time)) > 0.0)) {
        return Error{"must part from the surface that the body is in contact with", "velocity"};
    }
    impl_->now(id).steer(velocity);
    return success();
}

Status World::setStyle(BodyId id, const Style& style) {
    BodySlot* body = impl_->find(id);
    if (body == nullptr) {
        return kUnknownBody;
    }
    if (auto error = checkStyle(style)) {
        return *error;
    }
    body->style = style;
    if (body->phase.is<Flight>()) {
        impl_->fly(id, impl_->velocityIn(id.slot - 1), impl_->now(id).held());
    }
    return success();
}

Status World::setGravity(const Vec3& gravity) {
    if (auto error = checkVector(gravity, kMostGravity, "gravity")) {
        return *error;
    }
    for (std::size_t i = 0; i < impl_->bodies.size(); ++i) {
        if (impl_->bodies[i].used) {
            (void)impl_->whole(i);
        }
    }
    impl_->around.gravity = gravity;
    for (std::size_t i = 0; i < impl_->bodies.size(); ++i) {
        const BodySlot& body = impl_->bodies[i];
        if (!body.used) {
            continue;
        }
        const auto* rest = body.phase.as<Rest>();
        if (body.phase.is<Flight>() || body.phase.is<Slide>() ||
            (rest != nullptr && !canHold(rest->surface, impl_->time, gravity, body.style))) {
            impl_->now(idOfBody(i, body)).wake();
        }
    }
    return success();
}

/// The obstacle goes on otherwise: so does what is on it.
void World::Impl::follow(BodyId id, ObstacleId obstacle, const MovingFrame& frame) {
    const Phase& before = find(id)->phase;
    const auto isOfIt = [&](const KeptClear& kept) { return kept.obstacle == obstacle; };
    const bool flies = before.is<Flight>();
    const bool concerns =
        (!flies && before.obstacle == obstacle) || std::any_of(before.clear_of.begin(), before.clear_of.end(), isOfIt);
    if (!concerns || hasLeftAll(before, time)) {
        return;
    }
    BodySlot& body = whole(id.slot - 1);
    Phase phase = body.phase;
    for (KeptClear& kept : phase.clear_of) {
        kept.surface.frame = isOfIt(kept) ? frame : kept.surface.frame;
    }
    if (phase.is<Slide>()) {
        // The body goes on with the velocity that it had, off the surface as it moves from now on.
        const Vec3 velocity = velocityAt(body.phase, *body.shape, time);
        if (phase.obstacle == obstacle) {
            phase.edit<Slide>().surface.frame = frame;
        }
        body.phase = phase;
        now(id).wake(now(id).held(), velocity);
        return;
    }
    phase.start = time;
    if (flies) {
        body.phase.clear_of = phase.clear_of;
        now(id).flyOn();
        return;
    }
    bool drops = false;
    if (phase.obstacle == obstacle) {
        const bool rests = phase.is<Rest>();
        Surface& surface = rests ? phase.edit<Rest>().surface : phase.edit<Impact>().surface;
        if (rests) {
            const Vec3 point = surface.pointAt(time);
            const Vec3 change = frame.velocityAt(time, point) - surface.frame.velocityAt(time, point);
            drops = glm::dot(change, surface.normalAt(time)) < 0.0;
        }
        surface.frame = frame;
        if (rests) {
            const double end = holdsUntil(surface, time, around.gravity, body.style);
            phase.end =
                end >= time || phase.clear_of.empty() ? std::max(end, time) : std::numeric_limits<double>::infinity();
        }
    }
    // What drops away leaves the body with the velocity that it had.
    const Vec3 velocity = velocityAt(body.phase, *body.shape, time);
    now(id).begin(phase);
    if (drops) {
        now(id).wake(now(id).held(), velocity);
    }
}

Status World::setObstacleMotion(ObstacleId id, const Vec3& velocity, const Vec3& angular_velocity) {
    ObstacleSlot* obstacle = impl_->find(id);
    if (obstacle == nullptr) {
        return kUnknownObstacle;
    }
    if (auto error = checkVector(velocity, kMostSpeed, "velocity")) {
        return *error;
    }
    if (auto error = checkVector(angular_velocity, kMostSpin, "angular_velocity")) {
        return *error;
    }
    const double t = impl_->time;
    obstacle->path.keys.clear();
    impl_->setFrame(id.slot - 1,
                    {t, obstacle->frame.originAt(t), obstacle->frame.orientationAt(t), velocity, angular_velocity});
    return success();
}

/// The obstacle goes on from where it is otherwise; what is on it goes along.
void World::Impl::setFrame(std::size_t index, const MovingFrame& frame) {
    ObstacleSlot& obstacle = around.obstacles[index];
    obstacle.frame = frame;
    around.include(index, time);
    const ObstacleId id = idOfObstacle(index, obstacle);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies[i].used) {
            follow(idOfBody(i, bodies[i]), id, frame);
        }
    }
}

/// A body at rest that the obstacle has come into flies, and is put out by the touch.
void World::Impl::disturb(std::size_t obstacle) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const BodySlot& body = bodies[i];
        if (!body.used || !body.phase.is<Rest>()) {
            continue;
        }
        const auto found = overlapWith(obstacle, *body.shape, poseAt(body.phase, *body.shape, time));
        if (found && found->depth > 1e-6 * body.shape->length()) {
            now(idOfBody(i, body)).wake();
        }
    }
}

Status World::setObstaclePose(ObstacleId id, const Vec3& position, const Quat& rotation) {
    ObstacleSlot* obstacle = impl_->find(id);
    if (obstacle == nullptr) {
        return kUnknownObstacle;
    }
    if (auto error = checkPlace(position, rotation)) {
        return *error;
    }
    for (std::size_t i = 0; i < impl_->bodies.size(); ++i) {
        if (impl_->bodies[i].used) {
            impl_->letGo(idOfBody(i, impl_->bodies[i]), id);
        }
    }
    obstacle->path.keys.clear();
    obstacle->frame = {impl_->time, position, unitOf(rotation), Vec3(0.0), Vec3(0.0)};
    impl_->around.include(id.slot - 1, impl_->time);
    impl_->disturb(id.slot - 1);
    return success();
}

Status World::moveObstacle(ObstacleId id, const Vec3& position, const Quat& rotation, double duration) {
    ObstacleSlot* obstacle = impl_->find(id);
    if (obstacle == nullptr) {
        return kUnknownObstacle;
    }
    if (auto error = checkPlace(position, rotation)) {
        return *error;
    }
    if (!(duration > 0.0 && duration <= kMostStep)) {
        return Error{"must be above 0 and at most 1e6 s, is " + shortNumber(duration), "duration"};
    }
    const double t = impl_->time;
    Path path{
        t, obstacle->frame.originAt(t), obstacle->frame.orientationAt(t), {{duration, position, rotation}}, false};
    const MovingFrame frame = frameAt(path, t);
    if (auto error = checkVector(frame.velocity, kMostSpeed, "position")) {
        return Error{"is too far for so short a time: that would take " + shortNumber(glm::length(frame.velocity)) +
                         " m/s, and the most is " + shortNumber(kMostSpeed),
                     "position"};
    }
    obstacle->path = std::move(path);
    impl_->setFrame(id.slot - 1, frame);
    return success();
}
} // namespace elastoon
