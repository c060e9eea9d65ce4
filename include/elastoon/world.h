// The world: bodies that squash and stretch, obstacles that they meet, and the step that moves them.
#pragma once

#include "elastoon/export.h"
#include "elastoon/ids.h"
#include "elastoon/math.h"
#include "elastoon/phase.h"
#include "elastoon/result.h"
#include "elastoon/shape.h"
#include "elastoon/style.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace elastoon ELASTOON_API {

/// Runs body(begin, end) over parts of 0..count, in any order, on any threads, and returns when all are done.
/// A host gives its own job system here. The results of a step do not depend on how the range is cut.
using ParallelFor = std::function<void(std::size_t count, const std::function<void(std::size_t, std::size_t)>& body)>;

struct WorldDef {
    Vec3 gravity{0.0, -9.81, 0.0}; ///< m/s^2, each component within +-1e6. Default earth's, y up. Paper, section 3.
    ParallelFor parallel_for;      ///< empty: on the calling thread
    /// A clock of the host, s, for World::profile(); empty: nothing is measured. The library reads none itself.
    std::function<double()> clock = {};
};

/// Where the time of the last step went, s by WorldDef::clock. docs/step.md tells the parts. Only to look at: nothing
/// in the motion depends on it.
struct StepProfile {
    double prepare = 0.0; ///< obstacles' boxes are brought to where they will be
    double advance = 0.0; ///< bodies: searches for what comes next, and events
    double follow_paths = 0.0; ///< obstacles take the next leg of their path
    double sort_events = 0.0;
    double matrices = 0.0; ///< of the calls of matrices() since the step
    std::size_t advanced = 0; ///< bodies that were not known to be quiet until its end
};

/// Start state of a body. It is turned so that its principal axis, +x end first, lies along its heading.
struct BodyDef {
    ShapePtr shape; ///< required
    Style style;
    Vec3 position{0.0};            ///< of the centroid, m, within +-1e9
    Vec3 velocity{0.0};            ///< m/s, within +-1e6
    Quat rotation{kNoRotation};    ///< any length but zero; only its roll about the heading is kept
    std::uint64_t user_data = 0;   ///< yours; not read
};

/// A place on an obstacle's path.
struct PathKey {
    double time = 0.0; ///< s after the obstacle was added; ascending, > 0
    Vec3 position{0.0};
    Quat rotation{kNoRotation};
};

/// A plane (shape empty) or a convex solid that bodies meet. It does not give way.
struct ObstacleDef {
    ShapePtr shape;             ///< empty: the half space below the plane through `position`, across `normal`
    Vec3 normal{0.0, 1.0, 0.0}; ///< of a plane, any length but zero, in the obstacle's frame
    Vec3 position{0.0};         ///< m, within +-1e9
    Quat rotation{kNoRotation}; ///< any length but zero
    Vec3 velocity{0.0};         ///< m/s, within +-1e6
    Vec3 angular_velocity{0.0}; ///< world axes, rad/s, within +-1e4
    /// From where it is added it goes from key to key, between two with constant velocity (within 1e6 m/s) and by the
    /// smallest turn (within 1e4 rad/s); at the last it stops. Not empty: velocity and angular_velocity are not read.
    std::vector<PathKey> path;
    /// From the last key (at 0.001 s or later) it jumps back to where it was added: make the two the same place.
    bool path_repeats = false;
    std::uint64_t user_data = 0; ///< yours; not read

    [[nodiscard]] bool moves() const;
    /// The plane { x : x . normal = offset }, solid on the side that the normal points away from.
    [[nodiscard]] static ObstacleDef plane(const Vec3& normal, double offset);
};

enum class EventType : std::uint8_t {
    Impact, ///< a touch began an impact
    Release, ///< an impact ended and the body flies
    Rest, ///< an impact ended and the body is still
    Wake, ///< a body at rest flies again
    Squeeze, ///< a body has no room left
};

[[nodiscard]] std::string_view nameOf(EventType type);

/// Something that happened in the last step. The curve's fields hold for Impact; elsewhere they repeat the last
/// impact's (Release, Rest) or are those of standing still (Wake).
struct Event {
    double time = 0.0;
    EventType type = EventType::Impact;
    BodyId body;
    ObstacleId other;
    Vec3 point{0.0}; ///< contact, world
    Vec3 normal{0.0}; ///< towards the body, world
    double speed = 0.0; ///< relative to the surface: before the impact, or after it for Release, m/s
    double s_in = 1.0, s_mid = 1.0, s_out = 1.0;
    double t_in = 0.0, t_out = 0.0;
};

/// How the obstacle of this definition, added at time `added`, moves at time t if nobody changes it.
[[nodiscard]] MovingFrame frameAt(const ObstacleDef& def, double added, double t);

/// How a body would start inside an obstacle.
struct Overlap {
    ObstacleId obstacle;
    double depth = 0.0; ///< m
    Vec3 normal{0.0}; ///< way out, unit
};

/// A phase that began in the last step: the chain of them is the body's whole motion.
struct PhaseBegun {
    BodyId body;
    Phase phase;
};

/// What a body will do. Each phase holds until the next begins; the first one holds now.
struct Prediction {
    std::vector<Phase> phases;
    std::vector<Event> events; ///< the first impact among them is the first touch
    /// The body's pose at time t, from now to the horizon.
    [[nodiscard]] Pose poseAt(const Shape& shape, double t) const;
};

struct SnapshotOptions {
    /// With the shapes themselves, for a world that does not know them: another program, a saved game. Else they are
    /// only named.
    bool include_shapes = false;
};

/// Bodies do not meet each other; obstacles do not react. Not thread-safe: one call at a time on one world.
class World {
public:
    /// Gravity that is not finite or too large is refused.
    static Result<World> create(const WorldDef& def = {});
    World(World&&) noexcept;
    World& operator=(World&&) noexcept;
    ~World();

    /// Refused: no shape, numbers that are not finite or out of range, a style out of range, a start inside an obstacle
    /// deeper than 1e-6 of the body's length.
    Result<BodyId> addBody(const BodyDef& def);
    /// Where a body of this definition (which must be a valid one) would start deeper than 1e-6 of its length inside an
    /// obstacle: the deepest such place. For games that look for room.
    [[nodiscard]] std::optional<Overlap> overlapOf(const BodyDef& def) const;
    /// False if the id names nothing here. May be called at any time between steps, as all that follow.
    bool removeBody(BodyId id);
    Result<ObstacleId> addObstacle(const ObstacleDef& def);
    /// Bodies that rest on it or are in an impact with it fly on.
    bool removeObstacle(ObstacleId id);

    [[nodiscard]] bool contains(BodyId id) const;
    [[nodiscard]] bool contains(ObstacleId id) const;
    /// All bodies, in the order of their slots.
    [[nodiscard]] std::vector<BodyId> bodies() const;
    [[nodiscard]] std::vector<ObstacleId> obstacles() const;

    /// Puts the body there and lets it fly with its present velocity. Refused inside an obstacle.
    Status setPosition(BodyId id, const Vec3& position);
    /// The body flies with this velocity from now on; the end of it that is nearer to the heading leads.
    Status setVelocity(BodyId id, const Vec3& velocity);
    /// An impact's outcome, for a game's paddle: the body turns and stretches about its contact towards this velocity
    /// (world) and leaves with it. The impact takes it over smoothly: its turn in the squash half, later its velocity
    /// alone. Where the surface changes its own velocity afterwards, steer again. Refused: a body that is in no impact,
    /// and a velocity that does not part from the surface.
    Status steerImpact(BodyId id, const Vec3& velocity);
    /// Holds from the body's next phase on; a flight takes it over at once.
    Status setStyle(BodyId id, const Style& style);
    /// Flights go on under the new gravity.
    Status setGravity(const Vec3& gravity);
    /// The obstacle goes on from where it is with these velocities, and leaves its path; bodies on it go along.
    Status setObstacleMotion(ObstacleId id, const Vec3& velocity, const Vec3& angular_velocity);

    /// The obstacle is there from now on and stands still. What rested on it stays behind.
    Status setObstaclePose(ObstacleId id, const Vec3& position, const Quat& rotation);
    /// The obstacle goes there within `duration` s (> 0), with constant velocity and by the smallest turn, and stops.
    Status moveObstacle(ObstacleId id, const Vec3& position, const Quat& rotation, double duration);

    /// The body's coming phases and events up to `horizon` s from now, as far as nothing is changed meanwhile. The
    /// world stays as it is. The id must be one that contains() knows; horizon: finite, >= 0.
    [[nodiscard]] Prediction predict(BodyId id, double horizon) const;

    /// Moves the world on by dt seconds. docs/step.md tells how. dt: finite, >= 0 (else nothing happens; asserts).
    void step(double dt);

    /// Seconds since the world was made.
    [[nodiscard]] double time() const;
    [[nodiscard]] const Vec3& gravity() const;
    /// What happened in the last step, by time, then by body. Valid until the next step.
    [[nodiscard]] std::span<const Event> events() const;
    /// The phases that began since the start of the last step, user changes included; by body, then by time.
    [[nodiscard]] std::span<const PhaseBegun> phasesBegun() const;

    /// Of all bodies, for drawing: 12 floats for each slot, so those of `id` begin at 12 * (id.slot - 1). They are the
    /// three columns of linearOf(pose), then the position; zero in slots without a body. Quicker than pose() for each:
    /// many flights are worked out at once, and what is still is not looked at. Valid until the world is changed or
    /// stepped.
    [[nodiscard]] std::span<const float> matrices();

    /// All zero without WorldDef::clock, but for the count.
    [[nodiscard]] const StepProfile& profile() const;

    /// The following need an id that contains() knows.
    [[nodiscard]] Pose pose(BodyId id) const;
    [[nodiscard]] Vec3 velocity(BodyId id) const;
    [[nodiscard]] Phase phase(BodyId id) const;
    [[nodiscard]] const ShapePtr& shape(BodyId id) const;
    [[nodiscard]] const Style& style(BodyId id) const;
    [[nodiscard]] std::uint64_t userData(BodyId id) const;
    /// Frame of the obstacle: where it is now and how it moves.
    [[nodiscard]] const MovingFrame& frame(ObstacleId id) const;
    [[nodiscard]] const ShapePtr& shape(ObstacleId id) const; ///< null for a plane
    [[nodiscard]] Vec3 planeNormal(ObstacleId id) const; ///< of a plane, in its frame
    [[nodiscard]] std::uint64_t userData(ObstacleId id) const;

    /// 64 bits over time and over every body's phase and pose: equal worlds have equal hashes, on every machine.
    [[nodiscard]] std::uint64_t stateHash() const;

    /// All that later steps read, as bytes: a world restored from them goes on to the bit. The events and phases of the
    /// last step and the parallel_for are not in them. docs/snapshot.md.
    [[nodiscard]] std::vector<std::byte> snapshot(const SnapshotOptions& options = {}) const;
    /// The same over what `out_bytes` held: with a vector that is used again, nothing is allocated.
    void snapshotInto(std::vector<std::byte>& out_bytes, const SnapshotOptions& options = {}) const;
    /// Makes this world the one of the snapshot; events() and phasesBegun() are empty until the next step. Shapes are
    /// found by content among those of this world and its earlier snapshots, those given as known, and those in the
    /// bytes. Refused, with the world as it was: bytes that are damaged, of another version, or unsound, and shapes
    /// that are not found.
    Status restore(std::span<const std::byte> bytes, std::span<const ShapePtr> known = {});

private:
    struct Impl;
    explicit World(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

} // namespace elastoon ELASTOON_API
