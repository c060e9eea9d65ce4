// See world.h: making a world and asking it. What users change is in world_change.cpp, the step in world_step.cpp.
#include "elastoon/world.h"

#include "check_input.h"
#include "contact.h"
#include "hash.h"
#include "impact.h"
#include "line_contact.h"
#include "rotation.h"
#include "stopwatch.h"
#include "world_impl.h"

#include <algorithm>
#include <iterator>
#include <optional>

namespace elastoon {

namespace {

template <class Slots>
std::size_t takeSlot(Slots& slots, std::vector<std::uint32_t>& free) {
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
    impl->clock = def.clock;
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
    std::vector<std::size_t> candidates;
    const double reach = glm::length(scaleOf(pose.stretch)) * shape.boundingRadius();
    around.solids.meeting({pose.position - reach, pose.position + reach}, candidates);
    for (const Surroundings::Plane& plane : around.planes) {
        candidates.push_back(plane.slot);
    }
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

Error overlapError(const Overlap& overlap) {
    return {"starts " + shortNumber(overlap.depth) + " m inside obstacle " + std::to_string(overlap.obstacle.slot - 1) +
                "; move it out along the obstacle's normal by that much",
            "position"};
}

BodySlot World::Impl::bodyIn(std::size_t slot) const {
    BodySlot body = bodies[slot];
    if (MatrixTable::isTaken(body.phase)) {
        body.phase.motion = matrices.flight(slot);
    }
    return body;
}

Pose World::Impl::poseIn(std::size_t slot) const {
    const BodySlot& body = bodies[slot];
    return MatrixTable::isTaken(body.phase) ? unpushedPose(matrices.flight(slot), time - body.phase.start)
                                            : poseAt(body.phase, *body.shape, time);
}

Vec3 World::Impl::velocityIn(std::size_t slot) const {
    const BodySlot& body = bodies[slot];
    return MatrixTable::isTaken(body.phase) ? flightVelocity(matrices.flight(slot), time - body.phase.start)
                                            : velocityAt(body.phase, *body.shape, time);
}

namespace {

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
    impl_->unsettle(index);
    Moment(impl_->around, slot, id, impl_->time, impl_->pending).fly(pose, def.velocity, Lead::PlusX);
    return id;
}

bool World::removeBody(BodyId id) {
    BodySlot* slot = impl_->find(id);
    if (slot == nullptr) {
        return false;
    }
    releaseSlot(*slot, id.slot - 1, impl_->free_bodies);
    impl_->unsettle(id.slot - 1);
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

Pose Prediction::poseAt(const Shape& shape, double t) const {
    const auto after = std::upper_bound(phases.begin(), phases.end(), t,
                                        [](double time, const Phase& phase) { return time < phase.start; });
    return elastoon::poseAt(after == phases.begin() ? phases.front() : *std::prev(after), shape, t);
}

Prediction World::predict(BodyId id, double horizon) const {
    const bool valid = horizon >= 0.0 && horizon <= kMostStep;
    ELASTOON_ASSERT(valid, "horizon must be finite, not negative, and at most 1e6 s");
    Prediction prediction;
    impl_->known(id);
    BodySlot body = impl_->bodyIn(id.slot - 1);
    prediction.phases.push_back(body.phase);
    Happenings ahead;
    if (valid && !impl_->around.anyMoves()) {
        advanceBody(impl_->around, body, id, impl_->time, impl_->time + horizon, ahead);
    } else if (valid) {
        // What moves must be told of the time ahead: in a world of its own, with this body alone.
        Impl alone;
        alone.around = impl_->around;
        alone.time = impl_->time;
        alone.bodies.push_back(std::move(body));
        alone.unsettle(0);
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
    impl_->known(id);
    return impl_->poseIn(id.slot - 1);
}

const StepProfile& World::profile() const {
    return impl_->profile;
}

std::span<const float> World::matrices() {
    const Stopwatch watch(impl_->clock, impl_->profile.matrices);
    return impl_->matrices.at(impl_->time, impl_->bodies, impl_->around.gravity, impl_->parallel_for);
}

Vec3 World::velocity(BodyId id) const {
    impl_->known(id);
    return impl_->velocityIn(id.slot - 1);
}

Phase World::phase(BodyId id) const {
    impl_->known(id);
    return impl_->bodyIn(id.slot - 1).phase;
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

std::uint64_t World::userData(ObstacleId id) const {
    return impl_->known(id).user_data;
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
        const Pose pose = impl_->poseIn(i);
        const Vec3 velocity = impl_->velocityIn(i);
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
