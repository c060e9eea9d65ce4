// See recorder.h.
#include "elastoon/recorder.h"

#include "check_input.h"
#include "state_check.h"
#include "state_fields.h"

#include <algorithm>
#include <array>
#include <string>

namespace elastoon {

namespace {

constexpr Envelope kEnvelope{"ELASTREC", 1, "recording"};

Error unsound(const std::string& where, const std::string& what) {
    return {where + " is unsound: " + what, "recording"};
}

template <class Stream>
void fields(Stream& stream, Of<BodyDef> auto& def) {
    stream.shape(def.shape);
    stream(def.position, def.velocity, def.rotation, def.user_data);
    elastoon::fields(stream, def.style);
}

template <class Stream>
void fields(Stream& stream, Of<ObstacleDef> auto& def) {
    stream.shape(def.shape);
    stream(def.normal, def.position, def.rotation, def.velocity, def.angular_velocity, def.path_repeats, def.user_data);
    pathKeyFields(stream, def.path);
}

template <class Stream>
void fields(Stream& stream, Of<input::AddBody> auto& in) {
    stream(in.id);
    fields(stream, in.def);
}

template <class Stream>
void fields(Stream& stream, Of<input::AddObstacle> auto& in) {
    stream(in.id);
    fields(stream, in.def);
}

template <class Stream>
void fields(Stream& stream, Of<input::RemoveBody> auto& in) {
    stream(in.id);
}

template <class Stream>
void fields(Stream& stream, Of<input::RemoveObstacle> auto& in) {
    stream(in.id);
}

template <class Stream>
void fields(Stream& stream, Of<input::SetPosition> auto& in) {
    stream(in.id, in.position);
}

template <class Stream>
void fields(Stream& stream, Of<input::SetVelocity> auto& in) {
    stream(in.id, in.velocity);
}

template <class Stream>
void fields(Stream& stream, Of<input::SetStyle> auto& in) {
    stream(in.id);
    elastoon::fields(stream, in.style);
}

template <class Stream>
void fields(Stream& stream, Of<input::SetGravity> auto& in) {
    stream(in.gravity);
}

template <class Stream>
void fields(Stream& stream, Of<input::SetObstacleMotion> auto& in) {
    stream(in.id, in.velocity, in.angular_velocity);
}

template <class Stream>
void fields(Stream& stream, Of<input::SetObstaclePose> auto& in) {
    stream(in.id, in.position, in.rotation);
}

template <class Stream>
void fields(Stream& stream, Of<input::MoveObstacle> auto& in) {
    stream(in.id, in.position, in.rotation, in.duration);
}

template <class Stream>
void fields(Stream& stream, Of<input::SteerImpact> auto& in) {
    stream(in.id, in.velocity);
}

/// The world takes the rest at its own door when the input is applied; a definition must not even hold what no enum
/// names.
std::optional<Error> checkInput(const Input& what) {
    if (const auto* add = std::get_if<input::AddBody>(&what)) {
        return checkBodyDef(add->def);
    }
    if (const auto* add = std::get_if<input::AddObstacle>(&what)) {
        return checkObstacleDef(add->def);
    }
    const auto* set = std::get_if<input::SetStyle>(&what);
    return set != nullptr ? checkStyle(set->style) : std::nullopt;
}

/// One input's call.
struct Apply {
    World& world;

    template <class Id>
    static Status same(const Result<Id>& made, Id recorded) {
        if (!made) {
            return made.error();
        }
        return made.value() == recorded || !recorded
                   ? success()
                   : Error{"was given another id than when it was recorded: this world is not the recorded one", "id"};
    }
    Status operator()(const input::AddBody& in) const { return same(world.addBody(in.def), in.id); }
    Status operator()(const input::AddObstacle& in) const { return same(world.addObstacle(in.def), in.id); }
    Status operator()(const input::RemoveBody& in) const {
        return world.removeBody(in.id) ? success() : Error{"the id names no body of this world", "id"};
    }
    Status operator()(const input::RemoveObstacle& in) const {
        return world.removeObstacle(in.id) ? success() : Error{"the id names no obstacle of this world", "id"};
    }
    Status operator()(const input::SetPosition& in) const { return world.setPosition(in.id, in.position); }
    Status operator()(const input::SetVelocity& in) const { return world.setVelocity(in.id, in.velocity); }
    Status operator()(const input::SetStyle& in) const { return world.setStyle(in.id, in.style); }
    Status operator()(const input::SetGravity& in) const { return world.setGravity(in.gravity); }
    Status operator()(const input::SetObstacleMotion& in) const {
        return world.setObstacleMotion(in.id, in.velocity, in.angular_velocity);
    }
    Status operator()(const input::SetObstaclePose& in) const {
        return world.setObstaclePose(in.id, in.position, in.rotation);
    }
    Status operator()(const input::MoveObstacle& in) const {
        return world.moveObstacle(in.id, in.position, in.rotation, in.duration);
    }
    Status operator()(const input::SteerImpact& in) const { return world.steerImpact(in.id, in.velocity); }
};

constexpr std::array<const char*, std::variant_size_v<Input>> kNames{
    "addBody",  "removeBody", "addObstacle",       "removeObstacle",  "setPosition",  "setVelocity",
    "setStyle", "setGravity", "setObstacleMotion", "setObstaclePose", "moveObstacle", "steerImpact"};

} // namespace

void Recording::insert(std::size_t step, Input what) {
    const auto after = std::upper_bound(inputs.begin(), inputs.end(), step,
                                        [](std::size_t s, const TimedInput& timed) { return s < timed.step; });
    inputs.insert(after, {step, std::move(what)});
}

void Recording::cut(std::size_t step) {
    steps.resize(std::min(step, steps.size()));
    const auto forgotten =
        std::find_if(inputs.begin(), inputs.end(), [&](const TimedInput& timed) { return timed.step >= step; });
    inputs.erase(forgotten, inputs.end());
}

std::vector<std::byte> Recording::toBytes() const {
    std::vector<std::byte> bytes;
    ShapeTable table;
    StateWriter writer(bytes, table);
    beginEnvelope(writer, kEnvelope, 0);
    writer(std::uint64_t{0});
    writer.sized(start, 1);
    for (const std::byte b : start) {
        writer(b);
    }
    writer.sized(steps, 8);
    for (const double dt : steps) {
        writer(dt);
    }
    writer.sized(inputs, 9);
    for (const TimedInput& timed : inputs) {
        writer(std::uint64_t{timed.step});
        writer.choice(timed.input);
        std::visit([&](const auto& in) { fields(writer, in); }, timed.input);
    }
    writer.putAt(kEnvelopeBytes, std::uint64_t{writer.size()});
    writeShapes(writer, table, true);
    closeEnvelope(writer, bytes);
    return bytes;
}

namespace {

std::optional<Error> readRecording(StateReader& reader, Recording& recording) {
    reader.sized(recording.start, 1);
    for (std::byte& b : recording.start) {
        reader(b);
    }
    reader.sized(recording.steps, 8);
    for (double& dt : recording.steps) {
        reader(dt);
        if (!(dt >= 0.0 && dt <= kMostStep)) {
            return unsound("a step", "it must be from 0 to 1e6 s");
        }
    }
    reader.sized(recording.inputs, 9);
    std::size_t last = 0;
    for (std::size_t i = 0; i < recording.inputs.size() && reader.good(); ++i) {
        TimedInput& timed = recording.inputs[i];
        std::uint64_t step = 0;
        reader(step);
        timed.step = static_cast<std::size_t>(step);
        reader.choice(timed.input);
        std::visit([&](auto& in) { fields(reader, in); }, timed.input);
        const auto error = reader.good() ? checkInput(timed.input) : std::nullopt;
        if (error) {
            return unsound("input " + std::to_string(i), error->text());
        }
        if (timed.step < last || timed.step > recording.steps.size()) {
            return unsound("input " + std::to_string(i), "inputs must be in the order of their steps");
        }
        last = timed.step;
    }
    if (!reader.good() || reader.left() != 0) {
        return unsound("its list of inputs", "the bytes end too soon or too late, or hold what cannot be");
    }
    return std::nullopt;
}

} // namespace

Result<Recording> Recording::fromBytes(std::span<const std::byte> bytes) {
    const auto opened = openEnvelope(bytes, kEnvelope);
    if (!opened) {
        return opened.error();
    }
    const auto inside = opened.value().inside;
    ByteReader head(inside);
    std::uint64_t shapes_at = 0;
    head(shapes_at);
    if (opened.value().flags != 0 || shapes_at < kEnvelopeBytes + 8 || shapes_at > bytes.size()) {
        return unsound("its head", "the flags must be 0, and the list of shapes lie within it");
    }
    const std::size_t place = static_cast<std::size_t>(shapes_at) - kEnvelopeBytes;
    ByteReader shape_reader(inside.subspan(place));
    const auto shapes = readShapes(shape_reader, true, [](std::uint64_t) { return ShapePtr(); }, "recording");
    if (!shapes) {
        return shapes.error();
    }
    if (shape_reader.left() != 0) {
        return unsound("its end", "there are bytes too many");
    }
    Recording recording;
    StateReader reader(inside.subspan(8, place - 8), shapes.value());
    if (auto error = readRecording(reader, recording)) {
        return *error;
    }
    // The start is a snapshot with a seal of its own: it is tried on a world.
    World world = World::create().value();
    if (const Status status = world.restore(recording.start); !status) {
        return unsound("its start", status.error().message);
    }
    return recording;
}

Status apply(const Input& input, World& world) {
    return std::visit(Apply{world}, input);
}

Status replay(const Recording& recording, World& world, std::size_t from, std::size_t to) {
    const bool whole = to > recording.steps.size();
    const std::size_t end = std::min(to, recording.steps.size());
    auto next = std::lower_bound(recording.inputs.begin(), recording.inputs.end(), from,
                                 [](const TimedInput& timed, std::size_t step) { return timed.step < step; });
    for (std::size_t step = from; step < end || (step == end && whole); ++step) {
        for (; next != recording.inputs.end() && next->step == step; ++next) {
            if (const Status status = apply(next->input, world); !status) {
                return Error{status.error().text(),
                             "step " + std::to_string(step) + ", " + kNames[next->input.index()]};
            }
        }
        if (step < end) {
            world.step(recording.steps[step]);
        }
    }
    return success();
}

Result<World> replay(const Recording& recording, const ParallelFor& parallel_for) {
    World world = World::create({.gravity = Vec3(0.0), .parallel_for = parallel_for}).value();
    if (const Status status = world.restore(recording.start); !status) {
        return status.error();
    }
    if (const Status status = replay(recording, world, 0, kAllSteps); !status) {
        return status.error();
    }
    return world;
}

Recorder::Recorder(World& world) : world_(&world) {
    recording_.start = world.snapshot({.include_shapes = true});
}

/// What was refused has changed nothing.
Status Recorder::keep(const Status& status, Input input) {
    if (status) {
        recording_.inputs.push_back({recording_.steps.size(), std::move(input)});
    }
    return status;
}

Result<BodyId> Recorder::addBody(const BodyDef& def) {
    const auto id = world_->addBody(def);
    if (id) {
        (void)keep(success(), input::AddBody{def, id.value()});
    }
    return id;
}

bool Recorder::removeBody(BodyId id) {
    return world_->removeBody(id) && keep(success(), input::RemoveBody{id});
}

Result<ObstacleId> Recorder::addObstacle(const ObstacleDef& def) {
    const auto id = world_->addObstacle(def);
    if (id) {
        (void)keep(success(), input::AddObstacle{def, id.value()});
    }
    return id;
}

bool Recorder::removeObstacle(ObstacleId id) {
    return world_->removeObstacle(id) && keep(success(), input::RemoveObstacle{id});
}

Status Recorder::setPosition(BodyId id, const Vec3& position) {
    return keep(world_->setPosition(id, position), input::SetPosition{id, position});
}

Status Recorder::setVelocity(BodyId id, const Vec3& velocity) {
    return keep(world_->setVelocity(id, velocity), input::SetVelocity{id, velocity});
}

Status Recorder::steerImpact(BodyId id, const Vec3& velocity) {
    return keep(world_->steerImpact(id, velocity), input::SteerImpact{id, velocity});
}

Status Recorder::setStyle(BodyId id, const Style& style) {
    return keep(world_->setStyle(id, style), input::SetStyle{id, style});
}

Status Recorder::setGravity(const Vec3& gravity) {
    return keep(world_->setGravity(gravity), input::SetGravity{gravity});
}

Status Recorder::setObstacleMotion(ObstacleId id, const Vec3& velocity, const Vec3& angular_velocity) {
    return keep(world_->setObstacleMotion(id, velocity, angular_velocity),
                input::SetObstacleMotion{id, velocity, angular_velocity});
}

Status Recorder::setObstaclePose(ObstacleId id, const Vec3& position, const Quat& rotation) {
    return keep(world_->setObstaclePose(id, position, rotation), input::SetObstaclePose{id, position, rotation});
}

Status Recorder::moveObstacle(ObstacleId id, const Vec3& position, const Quat& rotation, double duration) {
    return keep(world_->moveObstacle(id, position, rotation, duration),
                input::MoveObstacle{id, position, rotation, duration});
}

void Recorder::step(double dt) {
    world_->step(dt);
    if (dt >= 0.0 && dt <= kMostStep) {
        recording_.steps.push_back(dt);
    }
}

} // namespace elastoon
