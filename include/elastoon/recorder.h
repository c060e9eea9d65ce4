// What a user does to a world, kept as data: replayed it gives the same world, to the bit. docs/snapshot.md.
#pragma once

#include "elastoon/export.h"
#include "elastoon/world.h"

#include <limits>
#include <variant>
#include <vector>

namespace elastoon ELASTOON_API {

/// The calls that change a world, as data.
namespace input {
struct AddBody {
    BodyDef def;
    BodyId id; ///< what the call gave when it was recorded, and must give again; null: any will do
};
struct RemoveBody {
    BodyId id;
};
struct AddObstacle {
    ObstacleDef def;
    ObstacleId id; ///< as AddBody's
};
struct RemoveObstacle {
    ObstacleId id;
};
struct SetPosition {
    BodyId id;
    Vec3 position{0.0};
};
struct SetVelocity {
    BodyId id;
    Vec3 velocity{0.0};
};
struct SetStyle {
    BodyId id;
    Style style;
};
struct SetGravity {
    Vec3 gravity{0.0};
};
struct SetObstacleMotion {
    ObstacleId id;
    Vec3 velocity{0.0};
    Vec3 angular_velocity{0.0};
};
struct SetObstaclePose {
    ObstacleId id;
    Vec3 position{0.0};
    Quat rotation{kNoRotation};
};
struct MoveObstacle {
    ObstacleId id;
    Vec3 position{0.0};
    Quat rotation{kNoRotation};
    double duration = 0.0; ///< s
};
struct SteerImpact {
    BodyId id;
    Vec3 velocity{0.0};
};
} // namespace input

using Input = std::variant<input::AddBody, input::RemoveBody, input::AddObstacle, input::RemoveObstacle,
                           input::SetPosition, input::SetVelocity, input::SetStyle, input::SetGravity,
                           input::SetObstacleMotion, input::SetObstaclePose, input::MoveObstacle, input::SteerImpact>;

struct TimedInput {
    std::size_t step = 0; ///< number of steps before it
    Input input;
};

/// A world's beginning and all that was done to it.
struct Recording {
    std::vector<std::byte> start; ///< snapshot of the world before the first step, with its shapes
    std::vector<double> steps; ///< dt of each step, s
    std::vector<TimedInput> inputs; ///< by step; of one step, in their order

    /// Adds an input, after those that the same step has: for one that comes late.
    void insert(std::size_t step, Input what);
    /// Forgets the inputs and steps from step `step` on: for a world that was restored to before them and goes another
    /// way.
    void cut(std::size_t step);
    /// With all shapes in them.
    [[nodiscard]] std::vector<std::byte> toBytes() const;
    /// Refused: bytes that are damaged, of another version, or unsound.
    static Result<Recording> fromBytes(std::span<const std::byte> bytes);
};

/// Gives the world one recorded input. Refused, as the world's own call; or when an id is not the recorded one: then
/// the world has gone another way than the recorded one.
Status apply(const Input& input, World& world);

inline constexpr std::size_t kAllSteps = std::numeric_limits<std::size_t>::max();

/// Takes a world that is where the recording's was before step `from` through its inputs and steps, up to step `to`
/// (which is not made, nor its inputs). Inputs after the last step are made if `to` is beyond it, as kAllSteps is. Ends
/// at the first input that is refused, and says which.
Status replay(const Recording& recording, World& world, std::size_t from = 0, std::size_t to = kAllSteps);
/// A world of its own, from the recording's start through all of it.
Result<World> replay(const Recording& recording, const ParallelFor& parallel_for = {});

/// Forwards each call to a world, and keeps those that were not refused.
class Recorder {
public:
    /// Records from the world's present state on. The world must outlive the recorder, and all that changes it must go
    /// through here.
    explicit Recorder(World& world);

    [[nodiscard]] const World& world() const { return *world_; }
    [[nodiscard]] const Recording& recording() const { return recording_; }
    /// Adds an input to the recording alone, for a step that is over: replay() then takes a restored world through it.
    void insert(std::size_t step, Input what) { recording_.insert(step, std::move(what)); }
    /// As Recording's, when the world was restored to a snapshot from before step `step`.
    void cut(std::size_t step) { recording_.cut(step); }

    /// As those of World.
    Result<BodyId> addBody(const BodyDef& def);
    bool removeBody(BodyId id);
    Result<ObstacleId> addObstacle(const ObstacleDef& def);
    bool removeObstacle(ObstacleId id);
    Status setPosition(BodyId id, const Vec3& position);
    Status setVelocity(BodyId id, const Vec3& velocity);
    Status steerImpact(BodyId id, const Vec3& velocity);
    Status setStyle(BodyId id, const Style& style);
    Status setGravity(const Vec3& gravity);
    Status setObstacleMotion(ObstacleId id, const Vec3& velocity, const Vec3& angular_velocity);
    Status setObstaclePose(ObstacleId id, const Vec3& position, const Quat& rotation);
    Status moveObstacle(ObstacleId id, const Vec3& position, const Quat& rotation, double duration);
    void step(double dt);

private:
    Status keep(const Status& status, Input input);

    World* world_;
    Recording recording_;
};

} // namespace elastoon ELASTOON_API
