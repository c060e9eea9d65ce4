// What a world holds: shared by what makes it, changes it, steps it and saves it.
#pragma once

#include "elastoon/assert.h"
#include "elastoon/world.h"
#include "large_array.h"
#include "matrix_table.h"
#include "step.h"

#include <limits>
#include <optional>
#include <vector>

namespace elastoon {

struct SnapshotMemory;
struct SnapshotState;

struct World::Impl {
    Surroundings around;
    ParallelFor parallel_for;
    std::function<double()> clock;
    StepProfile profile;
    double time = 0.0;
    LargeArray<BodySlot> bodies;
    /// By body slot: nothing happens to the body before, in surroundings of version `quiet_version`. A copy of what
    /// its plan says, for the step to run over.
    LargeArray<double> quiet_until;
    std::uint32_t quiet_version = 0;
    static constexpr double kNotQuiet = -std::numeric_limits<double>::infinity();
    MatrixTable matrices;
    std::vector<std::uint32_t> free_bodies, free_obstacles;
    std::vector<Event> events;
    std::vector<PhaseBegun> phases;
    /// Left by user changes since the last step; the next step takes them in.
    Happenings pending;
    /// Emptied lists, for the room that they have.
    std::vector<Happenings> spare;
    /// What snapshots and restores use again and again; null before the first. See snapshot.cpp.
    std::shared_ptr<SnapshotMemory> snapshots;

    SnapshotMemory& snapshotMemory();
    void become(SnapshotState& state);
    /// The slot of a body; its flight may be taken.
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
    /// What the body in this slot does, and is: also where its flight is taken.
    [[nodiscard]] BodySlot bodyIn(std::size_t slot) const;
    [[nodiscard]] Pose poseIn(std::size_t slot) const;
    [[nodiscard]] Vec3 velocityIn(std::size_t slot) const;
    /// For whatever happens to a body between steps.
    [[nodiscard]] BodySlot& whole(std::size_t slot) {
        if (matrices.giveBack(slot, bodies[slot].phase)) {
            matrices.changed(slot);
        }
        return bodies[slot];
    }
    [[nodiscard]] Moment now(BodyId id) {
        unsettle(id.slot - 1);
        return {around, whole(id.slot - 1), id, time, pending};
    }
    /// The body in this slot is not what it was.
    void unsettle(std::size_t slot) {
        quiet_until.resize(bodies.size(), kNotQuiet);
        quiet_until[slot] = kNotQuiet;
        matrices.changed(slot);
    }
    void fly(BodyId id, const Vec3& velocity, const std::vector<Left>& lefts);
    void follow(BodyId id, ObstacleId obstacle, const MovingFrame& frame);
    void letGo(BodyId id, ObstacleId obstacle);
    void disturb(std::size_t obstacle);
    void setFrame(std::size_t obstacle, const MovingFrame& frame);
    [[nodiscard]] double nextPathChange(double to) const;
    void followPaths();
    void takePending();
    [[nodiscard]] Happenings spareHappenings();
    void prepareStep(double until);
    void advanceBodies(double to);
    void advance(double to);
};

inline const Error kUnknownBody{"the id names no body of this world (was it removed?)", "id"};
inline const Error kUnknownObstacle{"the id names no obstacle of this world (was it removed?)", "id"};

/// How a body starts inside an obstacle, and what to do about it.
[[nodiscard]] Error overlapError(const Overlap& overlap);

} // namespace elastoon
