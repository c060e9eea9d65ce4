// World::snapshot and World::restore. A restore reads all into memory of its own, checks it there, and only then
// changes the world. docs/snapshot.md.
#include "byte_stream.h"
#include "check_input.h"
#include "state_check.h"
#include "state_fields.h"
#include "swept_box.h"
#include "world_impl.h"

#include <algorithm>
#include <map>
#include <string>

namespace elastoon {

namespace {

constexpr Envelope kEnvelope{"ELASTOON", 2, "snapshot"};
constexpr std::uint32_t kWithShapes = 1;

Error unsound(const std::string& where, const std::string& what) {
    return {where + " is unsound: " + what, "snapshot"};
}

} // namespace

/// All that a step reads. The lists and the tree of the surroundings are made from the obstacles.
struct SnapshotState {
    double time = 0.0;
    Vec3 gravity{0.0};
    std::uint32_t version = 0;
    std::vector<std::uint32_t> free_obstacles, free_bodies;
    LargeArray<ObstacleSlot> obstacles;
    LargeArray<BodySlot> bodies;
    Happenings pending;
};

struct SnapshotMemory {
    ShapeTable table;
    /// Shapes that this world's snapshots name, by content.
    std::map<std::uint64_t, ShapePtr> shapes;
    SnapshotState state;
};

namespace {

void writePlan(StateWriter& writer, const Plan& plan) {
    writer(plan.looked_until, plan.time, plan.window, plan.version, plan.kind, plan.meets());
    if (plan.meets()) {
        writer(plan.obstacle, plan.on_solid, plan.place->point, plan.place->normal);
    }
}

bool fitsPhase(Plan::Kind kind, const Phase& phase) {
    switch (kind) {
    case Plan::Kind::Meet:
        return true;
    case Plan::Kind::FlyOn:
        return phase.is<Flight>();
    case Plan::Kind::EndSlide:
        return phase.is<Slide>();
    case Plan::Kind::EndImpact:
        return phase.is<Impact>();
    case Plan::Kind::PressLetGo:
    case Plan::Kind::Wake:
        return phase.is<Rest>();
    }
    return false;
}

/// Null, or what would be right.
const char* readPlan(StateReader& reader, Plan& plan, const Phase& phase, const LargeArray<ObstacleSlot>& obstacles) {
    bool meets = false;
    plan = {};
    reader(plan.looked_until, plan.time, plan.window, plan.version, plan.kind, meets);
    if (!reader.good()) {
        return nullptr;
    }
    if (std::isnan(plan.looked_until) || std::isnan(plan.time) || !std::isfinite(plan.window)) {
        return "what a body does next must have numbers for times";
    }
    const bool nothing = plan.time == std::numeric_limits<double>::infinity();
    if (!fitsPhase(plan.kind, phase) || (!nothing && meets != (plan.kind == Plan::Kind::Meet))) {
        return "what a body does next must fit its phase";
    }
    if (!meets) {
        return nullptr;
    }
    Place place;
    reader(plan.obstacle, plan.on_solid, place.point, place.normal);
    if (!reader.good()) {
        return nullptr;
    }
    if (plan.obstacle >= obstacles.size() || !obstacles[plan.obstacle].used) {
        return "what a body meets next must be an obstacle";
    }
    const ObstacleSlot& obstacle = obstacles[plan.obstacle];
    if (obstacle.isPlane()) {
        return plan.on_solid ? "what a body meets next must be the obstacle's own surface" : nullptr;
    }
    plan.place = place;
    return flawOf(Surface{obstacle.frame, place.point, place.normal, plan.on_solid ? obstacle.shape : nullptr});
}

template <class List>
void writeNumbers(StateWriter& writer, const List& list) {
    writer.sized(list, 4);
    for (const std::uint32_t number : list) {
        writer(number);
    }
}

void readNumbers(StateReader& reader, std::vector<std::uint32_t>& list) {
    reader.sized(list, 4);
    for (std::uint32_t& number : list) {
        reader(number);
    }
}

template <class List>
void writeList(StateWriter& writer, const List& list) {
    writer.sized(list, 1);
    for (const auto& item : list) {
        fields(writer, item);
    }
}

/// Reads one state, and says what is wrong with it.
class StateParser {
public:
    StateParser(std::span<const std::byte> bytes, std::span<const ShapePtr> shapes, SnapshotState& state,
                const LargeArray<BodySlot>& bodies_now)
        : reader_(bytes, shapes), state_(state), bodies_now_(bodies_now) {}

    std::optional<Error> run();

private:
    std::optional<Error> readObstacles();
    std::optional<Error> readBodies();
    std::optional<Error> readBody(std::size_t index);
    std::optional<Error> readPending();
    [[nodiscard]] bool isCheckedStyle(const Style& style, std::size_t index) const;
    [[nodiscard]] static Error tooShort(const std::string& where) {
        return unsound(where, "the bytes end too soon, or hold what cannot be");
    }

    StateReader reader_;
    SnapshotState& state_;
    const LargeArray<BodySlot>& bodies_now_;
    const Style* checked_ = nullptr; ///< the last style that was found in range
    std::vector<bool> is_free_;
};

/// The free list must name every slot that is not in use, and each once.
template <class Slots>
const char* flawOfFree(const std::vector<std::uint32_t>& free, const Slots& slots, std::vector<bool>& is_free) {
    is_free.assign(slots.size(), false);
    for (const std::uint32_t index : free) {
        if (index >= slots.size() || slots[index].used || is_free[index]) {
            return "a free list must name slots that are not in use, each once";
        }
        is_free[index] = true;
    }
    const auto used =
        static_cast<std::size_t>(std::count_if(slots.begin(), slots.end(), [](const auto& slot) { return slot.used; }));
    return used + free.size() == slots.size() ? nullptr : "a free list must name all slots that are not in use";
}

/// Gives a slot that was read as free the values of a new one.
template <class Slot>
void resetFree(Slot& slot) {
    if (!slot.used) {
        const std::uint32_t generation = slot.generation;
        slot = Slot{};
        slot.generation = generation;
    }
}

std::optional<Error> StateParser::run() {
    reader_(state_.time, state_.gravity, state_.version);
    if (!(state_.time >= 0.0 && state_.time <= kMostTime)) {
        return unsound("the time", "it must be from 0 to 1e9 s");
    }
    if (auto error = checkVector(state_.gravity, kMostGravity, "gravity")) {
        return unsound("the gravity", error->message);
    }
    readNumbers(reader_, state_.free_obstacles);
    readNumbers(reader_, state_.free_bodies);
    if (auto error = readObstacles()) {
        return error;
    }
    if (auto error = readBodies()) {
        return error;
    }
    if (auto error = readPending()) {
        return error;
    }
    return reader_.left() == 0 ? std::nullopt
                               : std::optional(unsound("its end", std::to_string(reader_.left()) + " bytes too many"));
}

std::optional<Error> StateParser::readObstacles() {
    reader_.sized(state_.obstacles, kSlotBytes);
    for (std::size_t i = 0; i < state_.obstacles.size(); ++i) {
        ObstacleSlot& slot = state_.obstacles[i];
        fields(reader_, slot);
        if (!reader_.good()) {
            break;
        }
        resetFree(slot);
        if (const char* flaw = slot.used ? flawOf(slot, state_.time) : nullptr) {
            return unsound("obstacle " + std::to_string(i), flaw);
        }
    }
    if (!reader_.good()) {
        return tooShort("the list of obstacles");
    }
    const char* flaw = flawOfFree(state_.free_obstacles, state_.obstacles, is_free_);
    return flaw != nullptr ? std::optional(unsound("the list of obstacles", flaw)) : std::nullopt;
}

/// Most styles are those of the body before, or those that the world has already: checking ranges takes longer.
bool StateParser::isCheckedStyle(const Style& style, std::size_t index) const {
    return (checked_ != nullptr && style == *checked_) ||
           (index < bodies_now_.size() && bodies_now_[index].used &&
            style == static_cast<const Style&>(bodies_now_[index].style));
}

std::optional<Error> StateParser::readBody(std::size_t index) {
    BodySlot& slot = state_.bodies[index];
    const auto wrong = [&](const std::string& what) { return unsound("body " + std::to_string(index), what); };
    fields(reader_, slot);
    resetFree(slot);
    if (!slot.used || !reader_.good()) {
        return std::nullopt;
    }
    if (!slot.shape) {
        return wrong("it must have a shape");
    }
    if (!isCheckedStyle(slot.style, index)) {
        if (auto error = checkStyle(slot.style)) {
            return wrong(error->text());
        }
    }
    checked_ = &static_cast<const Style&>(slot.style);
    if (const char* flaw = flawOf(slot.phase, state_.time)) {
        return wrong(flaw);
    }
    const char* flaw = readPlan(reader_, slot.plan, slot.phase, state_.obstacles);
    return flaw != nullptr && reader_.good() ? std::optional(wrong(flaw)) : std::nullopt;
}

std::optional<Error> StateParser::readBodies() {
    reader_.sized(state_.bodies, kSlotBytes);
    for (std::size_t i = 0; i < state_.bodies.size() && reader_.good(); ++i) {
        if (auto error = readBody(i)) {
            return error;
        }
    }
    if (!reader_.good()) {
        return tooShort("the list of bodies");
    }
    const char* flaw = flawOfFree(state_.free_bodies, state_.bodies, is_free_);
    return flaw != nullptr ? std::optional(unsound("the list of bodies", flaw)) : std::nullopt;
}

std::optional<Error> StateParser::readPending() {
    Happenings& pending = state_.pending;
    reader_.sized(pending.events, kEventBytes);
    for (Event& event : pending.events) {
        fields(reader_, event);
        if (const char* flaw = flawOf(event)) {
            return unsound("an event that waits", flaw);
        }
    }
    reader_.sized(pending.phases, kPhaseBytes);
    for (PhaseBegun& begun : pending.phases) {
        fields(reader_, begun);
        if (const char* flaw = flawOf(begun.phase, state_.time)) {
            return unsound("a phase that waits", flaw);
        }
    }
    return reader_.good() ? std::nullopt : std::optional(tooShort("what waits for the next step"));
}

/// The lists and boxes from the obstacles. A solid that stands as before keeps its box, which its frame alone gives.
void rebuildSurroundings(Surroundings& around, const LargeArray<ObstacleSlot>& before, double t) {
    around.planes.clear();
    around.moving_planes.clear();
    around.moving_solids.clear();
    around.on_paths.clear();
    for (std::size_t i = 0; i < std::max(before.size(), around.obstacles.size()); ++i) {
        if (i >= around.obstacles.size() || !around.obstacles[i].used || around.obstacles[i].isPlane()) {
            around.solids.remove(i);
        }
    }
    for (std::size_t i = 0; i < around.obstacles.size(); ++i) {
        const ObstacleSlot& slot = around.obstacles[i];
        if (!slot.used) {
            continue;
        }
        if (!slot.path.keys.empty()) {
            around.on_paths.push_back(i);
        }
        const bool moves = slot.frame.moves();
        if (slot.isPlane()) {
            around.addPlane(i);
            if (moves) {
                around.moving_planes.push_back(i);
            }
            continue;
        }
        if (moves) {
            around.moving_solids.push_back(i);
        }
        const bool stands = i < before.size() && before[i].used && before[i].shape == slot.shape && !moves &&
                            !before[i].frame.moves() && before[i].frame.origin == slot.frame.origin &&
                            before[i].frame.orientation == slot.frame.orientation;
        if (!around.solids.contains(i)) {
            around.solids.insert(i, boxOf(*slot.shape, slot.frame, t));
        } else if (!stands) {
            around.solids.update(i, boxOf(*slot.shape, slot.frame, t));
        }
    }
}

/// Where the list of shapes begins, and what is before it and after.
struct Parts {
    std::span<const std::byte> state, shapes;
};

Result<Parts> partsOf(std::span<const std::byte> inside) {
    ByteReader reader(inside);
    std::uint64_t shapes_at = 0;
    reader(shapes_at);
    if (!reader.good() || shapes_at < kEnvelopeBytes + 8 || shapes_at > kEnvelopeBytes + inside.size()) {
        return unsound("its head", "the list of shapes must lie within it");
    }
    const std::size_t place = static_cast<std::size_t>(shapes_at) - kEnvelopeBytes;
    return Parts{inside.subspan(8, place - 8), inside.subspan(place)};
}

} // namespace

SnapshotMemory& World::Impl::snapshotMemory() {
    if (!snapshots) {
        snapshots = std::make_shared<SnapshotMemory>();
    }
    return *snapshots;
}

std::vector<std::byte> World::snapshot(const SnapshotOptions& options) const {
    std::vector<std::byte> bytes;
    snapshotInto(bytes, options);
    return bytes;
}

void World::snapshotInto(std::vector<std::byte>& out_bytes, const SnapshotOptions& options) const {
    const Impl& impl = *impl_;
    SnapshotMemory& memory = impl_->snapshotMemory();
    memory.table.clear();
    StateWriter writer(out_bytes, memory.table);
    beginEnvelope(writer, kEnvelope, options.include_shapes ? kWithShapes : 0);
    writer(std::uint64_t{0}, impl.time, impl.around.gravity, impl.around.version);
    writeNumbers(writer, impl.free_obstacles);
    writeNumbers(writer, impl.free_bodies);
    writeList(writer, impl.around.obstacles);
    writer.sized(impl.bodies, kSlotBytes);
    for (std::size_t i = 0; i < impl.bodies.size(); ++i) {
        const BodySlot& body = impl.bodies[i];
        if (body.used && MatrixTable::isTaken(body.phase)) {
            const BodySlot whole = impl.bodyIn(i);
            fields(writer, whole);
        } else {
            fields(writer, body);
        }
        if (body.used) {
            // A plan that is out of date is made anew.
            writePlan(writer, body.plan.version == impl.around.version ? body.plan : Plan{});
        }
    }
    writeList(writer, impl.pending.events);
    writeList(writer, impl.pending.phases);
    writer.putAt(kEnvelopeBytes, std::uint64_t{writer.size()});
    writeShapes(writer, memory.table, options.include_shapes);
    closeEnvelope(writer, out_bytes);
    for (const ShapePtr& shape : memory.table.shapes()) {
        memory.shapes.try_emplace(shape->contentHash(), shape);
    }
}

Status World::restore(std::span<const std::byte> bytes, std::span<const ShapePtr> known) {
    const auto opened = openEnvelope(bytes, kEnvelope);
    if (!opened) {
        return opened.error();
    }
    if (opened.value().flags > kWithShapes) {
        return unsound("its head", "flags must be 0 or 1");
    }
    const auto parts = partsOf(opened.value().inside);
    if (!parts) {
        return parts.error();
    }
    SnapshotMemory& memory = impl_->snapshotMemory();
    const auto find = [&](std::uint64_t hash) -> ShapePtr {
        const auto registered = memory.shapes.find(hash);
        if (registered != memory.shapes.end()) {
            return registered->second;
        }
        const auto is_it = [&](const ShapePtr& shape) { return shape && shape->contentHash() == hash; };
        for (const auto& body : impl_->bodies) {
            if (is_it(body.shape)) {
                return body.shape;
            }
        }
        for (const auto& obstacle : impl_->around.obstacles) {
            if (is_it(obstacle.shape)) {
                return obstacle.shape;
            }
        }
        const auto given = std::find_if(known.begin(), known.end(), is_it);
        return given != known.end() ? *given : nullptr;
    };
    ByteReader shape_reader(parts.value().shapes);
    const auto shapes = readShapes(shape_reader, opened.value().flags == kWithShapes, find, "snapshot");
    if (!shapes) {
        return shapes.error();
    }
    if (shape_reader.left() != 0) {
        return unsound("its end", std::to_string(shape_reader.left()) + " bytes too many");
    }
    SnapshotState& state = memory.state;
    if (auto error = StateParser(parts.value().state, shapes.value(), state, impl_->bodies).run()) {
        return *error;
    }
    impl_->become(state);
    return success();
}

/// What the world was goes into the state's memory, for the next restore to read over.
void World::Impl::become(SnapshotState& state) {
    time = state.time;
    std::swap(bodies, state.bodies);
    std::swap(free_bodies, state.free_bodies);
    std::swap(free_obstacles, state.free_obstacles);
    std::swap(pending, state.pending);
    std::swap(around.obstacles, state.obstacles);
    around.gravity = state.gravity;
    around.version = state.version;
    rebuildSurroundings(around, state.obstacles, time);
    quiet_until.assign(bodies.size(), kNotQuiet);
    matrices.allChanged();
    events.clear();
    phases.clear();
}

} // namespace elastoon
