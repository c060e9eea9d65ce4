// The parts of World::step, in its order. docs/step.md tells them in the same words.
#pragma once

#include "closest.h"
#include "elastoon/world.h"
#include "flight.h"
#include "obstacle_tree.h"

#include <array>
#include <optional>
#include <vector>

namespace elastoon {

/// Where V-Clip's last walk ended, for the few solids that a body is near to: kept from step to step, and copied with
/// the body, so that a copy goes on with the same bits.
class PairSeeds {
public:
    /// The pair's own; a new one in place of the one that has been longest unused.
    ClosestSeed& of(ObstacleId solid) {
        std::size_t oldest = 0;
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            if (pairs_[i].solid == solid) {
                pairs_[i].last_use = ++uses_;
                return pairs_[i].seed;
            }
            oldest = pairs_[i].last_use < pairs_[oldest].last_use ? i : oldest;
        }
        pairs_[oldest] = {solid, ++uses_, {}};
        return pairs_[oldest].seed;
    }

private:
    struct Pair {
        ObstacleId solid;
        std::uint64_t last_use = 0;
        ClosestSeed seed;
    };
    std::array<Pair, 4> pairs_{};
    std::uint64_t uses_ = 0;
};

struct BodySlot {
    std::uint32_t generation = 0;
    bool used = false;
    ShapePtr shape;
    Style style;
    Phase phase;
    PairSeeds seeds;
    std::uint64_t user_data = 0;
};

struct ObstacleSlot {
    std::uint32_t generation = 0;
    bool used = false;
    ShapePtr shape;             ///< null for a plane
    Vec3 normal{0.0, 1.0, 0.0}; ///< of a plane, unit, in the frame
    MovingFrame frame;
    std::uint64_t user_data = 0;

    [[nodiscard]] bool isPlane() const { return shape == nullptr; }
    /// The surface that a plane shows.
    [[nodiscard]] Surface surface() const { return {frame, Vec3(0.0), normal, nullptr}; }
};

/// What bodies meet and what pulls them: all that the motion of one body reads besides itself.
struct Surroundings {
    Vec3 gravity{0.0};
    std::vector<ObstacleSlot> obstacles;
    std::vector<std::size_t> planes;        ///< slots, ascending
    std::vector<std::size_t> moving_solids; ///< slots, ascending
    ObstacleTree solids;                    ///< boxes that hold now, and in a step through all of it

    /// To be called when an obstacle has come, goes, or moves otherwise; at time t.
    void include(std::size_t slot, double t);
    void exclude(std::size_t slot);
    /// Grows the boxes of moving solids to where they will be within [from, to].
    void prepareStep(double from, double to);
    /// Slots of the obstacles that a body in flight may touch within [from, to]: all planes, and the solids near its
    /// way.
    void near(const Phase& flight, const Shape& shape, double from, double to, std::vector<std::size_t>& found) const;
};

/// What the motion of bodies leaves behind.
struct Happenings {
    std::vector<Event> events;
    std::vector<PhaseBegun> phases;
};

[[nodiscard]] inline BodyId idOfBody(std::size_t index, const BodySlot& slot) {
    return {static_cast<std::uint32_t>(index + 1), slot.generation};
}
[[nodiscard]] inline ObstacleId idOfObstacle(std::size_t index, const ObstacleSlot& slot) {
    return {static_cast<std::uint32_t>(index + 1), slot.generation};
}

/// Gives the body its next phase and notes it.
void beginPhase(BodySlot& body, BodyId id, const Phase& phase, Happenings& out);

/// A surface that a body was held by or has brushed, and whose it is.
struct Left {
    Surface surface;
    ObstacleId obstacle;
    bool parts = false; ///< the body is known to part from it
};

/// Lets the body fly from this pose at time t. If it parts from the surface that it leaves, it is kept clear of it for
/// a while; else it meets it again at once.
void beginFlying(const Surroundings& around, BodySlot& body, BodyId id, double t, const Pose& pose,
                 const Vec3& velocity, Lead lead, const std::optional<Left>& left, Happenings& out);

/// Moves one body from time `from` to `to` through all its phases.
/// Reads the surroundings and no other body; writes the body's phase and `out`.
void advanceBody(const Surroundings& around, BodySlot& body, BodyId id, double from, double to, Happenings& out);

} // namespace elastoon
