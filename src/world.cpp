// See world.h: what a world holds, and what users may change. The motion itself is in step.cpp.
#include "elastoon/world.h"

#include "elastoon/assert.h"

#include "check_input.h"
#include "contact.h"
#include "gjk.h"
#include "hash.h"
#include "impact.h"
#include "rotation.h"
#include "step.h"

#include <algorithm>
#include <mutex>
#include <optional>

namespace elastoon {

struct World::Impl {
    Surroundings around;
    ParallelFor parallel_for;
    double time = 0.0;
    std::vector<BodySlot> bodies;
    std::vector<std::uint32_t> free_bodies, free_obstacles;
    std::vector<Event> events;
    std::vector<PhaseBegun> phases;
    /// Left by user changes since the last step; the next step takes them in.
    Happenings pending;

    BodySlot* find(BodyId id) {
        const bool known = id.slot != 0 && id.slot <= bodies.size();
        BodySlot* slot = known ? &bodies[id.slot - 1] : nullptr;
        return slot != nullptr && slot->used && slot->generation == id.generation ? slot : nullptr;
    }
    ObstacleSlot* find(ObstacleId id) {
        const bool known = id.slot != 0 && id.slot <= around.obstacles.size();
        ObstacleSlot* slot = known ? &around.obstacles[id.slot - 1] : nullptr;
        return slot != nullptr && slot->used && slot->generation == id.generation ? slot : nullptr;
    }
    const BodySlot& known(BodyId id) {
        const BodySlot* slot = find(id);
        ELASTOON_ASSERT(slot != nullptr, "the id names no body of this world");
        return *slot;
    }
    const ObstacleSlot& known(ObstacleId id) {
        const ObstacleSlot* slot = find(id);
        ELASTOON_ASSERT(slot != nullptr, "the id names no obstacle of this world");
        return *slot;
    }
    [[nodiscard]] std::optional<Overlap> overlapWith(std::size_t index, const Shape& shape, const Pose& pose) const;
    /// The deepest place where this pose penetrates an obstacle by more than 1e-6 of the length.
    [[nodiscard]] std::optional<Overlap> overlap(const Shape& shape, const Pose& pose) const;
    [[nodiscard]] Moment now(BodyId id) { return {around, *find(id), id, time, pending}; }
    void fly(BodyId id, const Vec3& velocity, const std::vector<Left>& lefts);
    void follow(BodyId id, ObstacleId obstacle, const MovingFrame& frame);
    void letGo(BodyId id, ObstacleId obstacle);
    void disturb(std::size_t obstacle);
    void setFrame(std::size_t obstacle, const MovingFrame& frame);
    [[nodiscard]] double nextPathChange(double to) const;
    void followPaths();
    void takePending();
    void advanceBodies(double to);
    void advance(double to);
};

namespace {

const Error kUnknownBody{"the id names no body of this world (was it removed?)", "id"};
const Error kUnknownObstacle{"the id names no obstacle of this world (was it removed?)", "id"};

template <class Slot>
std::size_t takeSlot(std::vector<Slot>& slots, std::vector<std::uint32_t>& free) {
    if (!free.empty()) {
        const std::uint32_t index = free.back();
        free.pop_back();
        return index;
    }
    slots.emplace_back();
    return slots.size() - 1;
}

/// Forgets what the slot held and counts its generation on.
template <class Slot>
void releaseSlot(Slot& slot, std::uint32_t index, std::vector<std::uint32_t>& free) {
    const std::uint32_t generation = slot.generation;
    slot = Slot{};
    slot.generation = generation;
    free.push_back(index);
}

} // namespace

ObstacleDef ObstacleDef::plane(const Vec3& normal, double offset) {
    ObstacleDef def;
    def.normal = normal;
    const double square = glm::dot(normal, normal);
    def.position = square > 0.0 ? normal * (offset / square) : Vec3(0.0);
    return def;
}

std::string_view nameOf(EventType type) {
    constexpr std::string_view kNames[] = {"impact", "release", "rest", "wake", "squeeze"};
    return kNames[static_cast<std::size_t>(type)];
}

World::World(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

Result<World> World::create(const WorldDef& def) {
    if (auto error = checkVector(def.gravity, kMostGravity, "gravity")) {
        return *error;
    }
    auto impl = std::make_unique<Impl>();
    impl->around.gravity = def.gravity;
    impl->parallel_for = def.parallel_for;
    return World(std::move(impl));
}

/// The depth along the obstacle's normal, or, in a solid, along the way from its centre; not positive: none.
std::optional<Overlap> World::Impl::overlapWith(std::size_t index, const Shape& shape, const Pose& pose) const {
    const ObstacleSlot& obstacle = around.obstacles[index];
    const ObstacleId id = idOfObstacle(index, obstacle);
    if (obstacle.isPlane()) {
        const Surface surface = obstacle.surface();
        return Overlap{id, -gapTo(surface, shape, pose, time), surface.normalAt(time)};
    }
    const Vec3 center = obstacle.frame.originAt(time);
    const PosedShape body{&shape, linearOf(pose), pose.position};
    const PosedShape solid{obstacle.shape.get(), glm::mat3_cast(obstacle.frame.orientationAt(time)), center};
    ClosestSeed seed;
    if (!closestPoints(body, solid, seed).overlap) {
        return std::nullopt;
    }
    const double between = glm::length(pose.position - center);
    const Vec3 out = between > 0.0 ? (pose.position - center) / between : Vec3(0.0, 1.0, 0.0);
    return Overlap{id, separationAlong(body, solid, out).value_or(0.0), out};
}

std::optional<Overlap> World::Impl::overlap(const Shape& shape, const Pose& pose) const {
    std::optional<Overlap> worst;
    double deepest = 1e-6 * shape.length();
    std::vector<std::size_t> candidates = around.planes;
    const double reach = glm::length(scaleOf(pose.stretch)) * shape.boundingRadius();
    around.solids.query({pose.position - reach, pose.position + reach},
                        [&](std::size_t slot) { candidates.push_back(slot); });
    std::sort(candidates.begin(), candidates.end());
    for (const std::size_t i : candidates) {
        const auto found = overlapWith(i, shape, pose);
        if (found && found->depth > deepest) {
            deepest = found->depth;
            worst = found;
        }
    }
    return worst;
}

namespace {

Error overlapError(const Overlap& overlap) {
    return {"starts " + shortNumber(overlap.depth) + " m inside obstacle " + std::to_string(overlap.obstacle.slot - 1) +
                "; move it out along the obstacle's normal by that much",
            "position"};
}

/// How a body of this definition would begin: turned to its heading, stretched by its speed.
Pose startPose(const BodyDef& def, const Vec3& gravity) {
    const Pose given{def.position, unitOf(def.rotation), 1.0};
    return unpushedPose(beginFlight(given, def.velocity, gravity, def.style, Lead::PlusX), 0.0);
}

} // namespace

std::optional<Overlap> World::overlapOf(const BodyDef& def) const {
    return checkBodyDef(def) ? std::nullopt : impl_->overlap(*def.shape, startPose(def, impl_->around.gravity));
}

Result<BodyId> World::addBody(const BodyDef& def) {
    if (auto error = checkBodyDef(def)) {
        return *error;
    }
    const Pose pose = startPose(def, impl_->around.gravity);
    if (const auto overlap = impl_->overlap(*def.shape, pose)) {
        return overlapError(*overlap);
    }
    const std::size_t index = takeSlot(impl_->bodies, impl_->free_bodies);
    BodySlot& slot = impl_->bodies[index];
    slot.used = true;
    ++slot.generation;
    slot.shape = def.shape;
    slot.style = def.style;
    slot.user_data = def.user_data;
    const BodyId id = idOfBody(index, slot);
    impl_->now(id).fly(pose, def.velocity, Lead::PlusX);
    return id;
}

bool World::removeBody(BodyId id) {
    BodySlot* slot = impl_->find(id);
    if (slot == nullptr) {
        return false;
    }
    releaseSlot(*slot, id.slot - 1, impl_->free_bodies);
    return true;
}

Result<ObstacleId> World::addObstacle(const ObstacleDef& def) {
    if (auto error = checkObstacleDef(def)) {
        return *error;
    }
    const std::size_t index = takeSlot(impl_->around.obstacles, impl_->free_obstacles);
    ObstacleSlot& slot = impl_->around.obstacles[index];
    slot.used = true;
    ++slot.generation;
    slot.shape = def.shape;
    slot.normal = glm::normalize(def.normal);
    slot.path = {impl_->time, def.position, def.rotation, def.path, def.path_repeats};
    slot.frame = frameAt(def, impl_->time, impl_->time);
    slot.user_data = def.user_data;
    impl_->around.include(index, impl_->time);
    impl_->disturb(index);
    return idOfObstacle(index, slot);
}

/// The obstacle is gone: what it held flies on, and nothing is kept clear of it.
void World::Impl::letGo(BodyId id, ObstacleId obstacle) {
    BodySlot& body = *find(id);
    const bool held = body.phase.obstacle == obstacle && !std::holds_alternative<Flight>(body.phase.motion);
    const auto isOfIt = [&](const KeptClear& kept) { return kept.obstacle == obstacle; };
    const bool near = std::any_of(body.phase.clear_of.begin(), body.phase.clear_of.end(), isOfIt);
    if (held) {
        std::vector<Left> lefts = now(id).held();
        std::erase_if(lefts, [&](const Left& left) { return left.obstacle == obstacle; });
        now(id).wake(lefts);
    } else if (near && std::holds_alternative<Rest>(body.phase.motion)) {
        now(id).recover();
    } else if (near) {
        // The push goes on as it was, or the body would jump; but it may meet the obstacle elsewhere.
        Phase phase = body.phase;
        for (KeptClear& kept : phase.clear_of) {
            kept.obstacle = isOfIt(kept) ? ObstacleId{} : kept.obstacle;
        }
        if (std::holds_alternative<Flight>(phase.motion)) {
            body.phase = phase;
            now(id).flyOn();
        } else {
            phase.start = time;
            now(id).begin(phase);
        }
    }
}

bool World::removeObstacle(ObstacleId id) {
    ObstacleSlot* obstacle = impl_->find(id);
    if (obstacle == nullptr) {
        return false;
    }
    impl_->around.exclude(id.slot - 1);
    releaseSlot(*obstacle, id.slot - 1, impl_->free_obstacles);
    for (std::size_t i = 0; i < impl_->bodies.size(); ++i) {
        const BodySlot& body = impl_->bodies[i];
        if (body.used) {
            impl_->letGo(idOfBody(i, body), id);
        }
    }
    return true;
}

bool World::contains(BodyId id) const {
    return impl_->find(id) != nullptr;
}

bool World::contains(ObstacleId id) const {
    return impl_->find(id) != nullptr;
}

std::vector<BodyId> World::bodies() const {
    std::vector<BodyId> ids;
    for (std::size_t i = 0; i < impl_->bodies.size(); ++i) {
        if (impl_->bodies[i].used) {
            ids.push_back(idOfBody(i, impl_->bodies[i]));
        }
    }
    return ids;
}

std::vector<ObstacleId> World::obstacles() const {
    std::vector<ObstacleId> ids;
    for (std::size_t i = 0; i < impl_->around.obstacles.size(); ++i) {
        if (impl_->around.obstacles[i].used) {
            ids.push_back(idOfObstacle(i, impl_->around.obstacles[i]));
        }
    }
    return ids;
}

/// The body flies on from its present pose; the stretch and axis become those of the velocity: at once if there is
/// room, else by and by.
void World::Impl::fly(BodyId id, const Vec3& velocity, const std::vector<Left>& lefts) {
    const BodySlot& body = *find(id);
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
    const Vec3 velocity = velocityAt(body->phase, *body->shape, impl_->time);
    Pose pose = poseAt(body->phase, *body->shape, impl_->time);
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

Status World::setStyle(BodyId id, const Style& style) {
    BodySlot* body = impl_->find(id);
    if (body == nullptr) {
        return kUnknownBody;
    }
    if (auto error = checkStyle(style)) {
        return *error;
    }
    body->style = style;
    if (std::holds_alternative<Flight>(body->phase.motion)) {
        impl_->fly(id, velocityAt(body->phase, *body->shape, impl_->time), impl_->now(id).held());
    }
    return success();
}

Status World::setGravity(const Vec3& gravity) {
    if (auto error = checkVector(gravity, kMostGravity, "gravity")) {
        return *error;
    }
    impl_->around.gravity = gravity;
    for (std::size_t i = 0; i < impl_->bodies.size(); ++i) {
        const BodySlot& body = impl_->bodies[i];
        if (!body.used) {
            continue;
        }
        const auto* rest = std::get_if<Rest>(&body.phase.motion);
        if (std::holds_alternative<Flight>(body.phase.motion) || std::holds_alternative<Slide>(body.phase.motion) ||
            (rest != nullptr && !canHold(rest->surface, impl_->time, gravity, body.style))) {
            impl_->now(idOfBody(i, body)).wake();
        }
    }
    return success();
}

/// The obstacle goes on otherwise: so does what is on it.
void World::Impl::follow(BodyId id, ObstacleId obstacle, const MovingFrame& frame) {
    BodySlot& body = *find(id);
    Phase phase = body.phase;
    bool concerns = false;
    for (KeptClear& kept : phase.clear_of) {
        if (kept.obstacle == obstacle) {
            kept.surface.frame = frame;
            concerns = true;
        }
    }
    const bool flies = std::holds_alternative<Flight>(phase.motion);
    if (!concerns && (flies || phase.obstacle != obstacle)) {
        return;
    }
    if (std::holds_alternative<Slide>(phase.motion)) {
        now(id).wake();
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
        auto* rest = std::get_if<Rest>(&phase.motion);
        Surface& surface = rest != nullptr ? rest->surface : std::get<Impact>(phase.motion).surface;
        if (rest != nullptr) {
            const Vec3 point = surface.pointAt(time);
            const Vec3 change = frame.velocityAt(time, point) - surface.frame.velocityAt(time, point);
            drops = glm::dot(change, surface.normalAt(time)) < 0.0;
        }
        surface.frame = frame;
        if (rest != nullptr) {
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
        if (!body.used || !std::holds_alternative<Rest>(body.phase.motion)) {
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

Pose Prediction::poseAt(const Shape& shape, double t) const {
    const auto after = std::upper_bound(phases.begin(), phases.end(), t,
                                        [](double time, const Phase& phase) { return time < phase.start; });
    return elastoon::poseAt(after == phases.begin() ? phases.front() : *std::prev(after), shape, t);
}

Prediction World::predict(BodyId id, double horizon) const {
    const bool valid = horizon >= 0.0 && horizon <= kMostStep;
    ELASTOON_ASSERT(valid, "horizon must be finite, not negative, and at most 1e6 s");
    Prediction prediction;
    prediction.phases.push_back(impl_->known(id).phase);
    Happenings ahead;
    if (valid && !impl_->around.anyMoves()) {
        BodySlot body = impl_->known(id);
        advanceBody(impl_->around, body, id, impl_->time, impl_->time + horizon, ahead);
    } else if (valid) {
        // What moves must be told of the time ahead: in a world of its own, with this body alone.
        Impl alone;
        alone.around = impl_->around;
        alone.time = impl_->time;
        alone.bodies.push_back(impl_->known(id));
        alone.advance(impl_->time + horizon);
        ahead = {std::move(alone.events), std::move(alone.phases)};
    }
    for (PhaseBegun& begun : ahead.phases) {
        prediction.phases.push_back(std::move(begun.phase));
    }
    prediction.events = std::move(ahead.events);
    for (Event& event : prediction.events) {
        event.body = id;
    }
    return prediction;
}

double World::Impl::nextPathChange(double to) const {
    double next = to;
    for (const std::size_t i : around.on_paths) {
        next = std::min(next, nextChange(around.obstacles[i].path, time));
    }
    return next;
}

/// Obstacles that have come to a key of their path take the next leg.
void World::Impl::followPaths() {
    const std::vector<std::size_t> on_paths = around.on_paths;
    for (const std::size_t i : on_paths) {
        const ObstacleSlot& obstacle = around.obstacles[i];
        const MovingFrame leg = frameAt(obstacle.path, time);
        if (leg.start > obstacle.frame.start) {
            setFrame(i, leg);
        }
    }
}

void World::Impl::takePending() {
    events = std::move(pending.events);
    phases = std::move(pending.phases);
    pending = {};
}

/// Bodies do not read each other, so any cut of the range gives the same motion.
void World::Impl::advanceBodies(double to) {
    struct Part {
        std::size_t begin;
        Happenings out;
    };
    std::vector<Part> parts;
    std::mutex guard;
    const auto advanceRange = [&](std::size_t begin, std::size_t end) {
        Part part{begin, {}};
        for (std::size_t i = begin; i < end; ++i) {
            if (bodies[i].used) {
                advanceBody(around, bodies[i], idOfBody(i, bodies[i]), time, to, part.out);
            }
        }
        const std::lock_guard lock(guard);
        parts.push_back(std::move(part));
    };
    if (parallel_for) {
        parallel_for(bodies.size(), advanceRange);
    } else {
        advanceRange(0, bodies.size());
    }
    std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.begin < b.begin; });
    for (Part& part : parts) {
        events.insert(events.end(), part.out.events.begin(), part.out.events.end());
        phases.insert(phases.end(), part.out.phases.begin(), part.out.phases.end());
    }
}

void World::step(double dt) {
    const bool valid = dt >= 0.0 && dt <= kMostStep;
    ELASTOON_ASSERT(valid, "dt must be finite, not negative, and at most 1e6 s");
    if (!valid) {
        return;
    }
    impl_->takePending();
    impl_->advance(impl_->time + dt);
}

/// From one change of an obstacle's motion to the next.
void World::Impl::advance(double to) {
    do {
        const double until = nextPathChange(to);
        around.prepareStep(time, until);
        advanceBodies(until);
        time = until;
        followPaths();
        events.insert(events.end(), pending.events.begin(), pending.events.end());
        phases.insert(phases.end(), pending.phases.begin(), pending.phases.end());
        pending = {};
    } while (time < to);
    std::stable_sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
        return a.time < b.time || (a.time == b.time && a.body.slot < b.body.slot);
    });
    std::stable_sort(phases.begin(), phases.end(),
                     [](const PhaseBegun& a, const PhaseBegun& b) { return a.body.slot < b.body.slot; });
}

double World::time() const {
    return impl_->time;
}

const Vec3& World::gravity() const {
    return impl_->around.gravity;
}

std::span<const Event> World::events() const {
    return impl_->events;
}

std::span<const PhaseBegun> World::phasesBegun() const {
    return impl_->phases;
}

Pose World::pose(BodyId id) const {
    const BodySlot& body = impl_->known(id);
    return poseAt(body.phase, *body.shape, impl_->time);
}

Vec3 World::velocity(BodyId id) const {
    const BodySlot& body = impl_->known(id);
    return velocityAt(body.phase, *body.shape, impl_->time);
}

const Phase& World::phase(BodyId id) const {
    return impl_->known(id).phase;
}

const ShapePtr& World::shape(BodyId id) const {
    return impl_->known(id).shape;
}

const Style& World::style(BodyId id) const {
    return impl_->known(id).style;
}

std::uint64_t World::userData(BodyId id) const {
    return impl_->known(id).user_data;
}

const MovingFrame& World::frame(ObstacleId id) const {
    return impl_->known(id).frame;
}

const ShapePtr& World::shape(ObstacleId id) const {
    return impl_->known(id).shape;
}

Vec3 World::planeNormal(ObstacleId id) const {
    return impl_->known(id).normal;
}

std::uint64_t World::stateHash() const {
    Hash hash;
    hash.add(impl_->time);
    for (std::size_t i = 0; i < impl_->bodies.size(); ++i) {
        const BodySlot& body = impl_->bodies[i];
        if (!body.used) {
            continue;
        }
        hash.add(std::uint64_t{body.generation} << 32 | (i + 1));
        hash.add(std::uint64_t{body.phase.motion.index()});
        hash.add(body.phase.start);
        const Pose pose = poseAt(body.phase, *body.shape, impl_->time);
        const Vec3 velocity = velocityAt(body.phase, *body.shape, impl_->time);
        for (int axis = 0; axis < 3; ++axis) {
            hash.add(pose.position[axis]);
            hash.add(velocity[axis]);
        }
        hash.add(pose.orientation.x);
        hash.add(pose.orientation.y);
        hash.add(pose.orientation.z);
        hash.add(pose.orientation.w);
        hash.add(pose.stretch);
    }
    return hash.value();
}

} // namespace elastoon
