// The matrices of all bodies of a world, for drawing: many flights are worked out at once, and what is still is not
// touched. docs/performance.md.
#pragma once

#include "flight_lanes.h"
#include "impact_lanes.h"
#include "large_array.h"
#include "prefetch.h"
#include "step.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace elastoon {

/// It draws flights from lanes, and takes them out of their phases for that, as soon as they need no push: a flight
/// that is taken is in its lane alone, and who reads the phase asks for it. One that has an ease is not taken.
class MatrixTable {
public:
    static constexpr std::size_t kFloats = kMatrixFloats;

    /// The body in this slot has begun a phase, has come or has gone. For different slots at the same time, too.
    void changed(std::size_t slot) {
        if (slot < changed_.size()) {
            changed_[slot] = Change::Unknown;
        }
    }
    /// All bodies are others. None of their flights is taken.
    void allChanged() {
        changed_.clear();
        blocks_.clear();
    }
    /// 12 floats a slot, as they are at time t: the columns of the linear part, then the position; 0 where there is no
    /// body. The same bits as from poseAt(). All flights have this gravity.
    std::span<const float> at(double t, LargeArray<BodySlot>& bodies, const Vec3& gravity,
                              const ParallelFor& parallel_for);

    [[nodiscard]] static bool isTaken(const Phase& phase) {
        const auto* flight = std::get_if<Boxed<Flight>>(&phase.motion);
        return flight != nullptr && flight->isUsual();
    }
    /// The flight that was taken out of the phase of the body in this slot.
    [[nodiscard]] Flight flight(std::size_t slot) const;
    /// Puts it back; false where it was not taken. For different slots at the same time, too.
    bool giveBack(std::size_t slot, Phase& phase) const;
    /// The phase, of which the flight was given back, is as it was.
    static void takeAgain(Phase& phase);
    /// The body has begun this phase, or changed it. Takes a flight that needs no push from time t on.
    void begun(std::size_t slot, Phase& phase, double t);
    /// What giveBack() will read.
    void prefetchFlight(std::size_t slot) const {
        if (slot / kLanes < blocks_.size()) {
            prefetch(&blocks_[slot / kLanes].lanes.eights[slot % kLanes / FlightLanes::kTogether],
                     sizeof(FlightLanes::Eight));
        }
    }

private:
    /// How a body is drawn from now on, as far as whoever changed it could tell: its slot then needs no look.
    enum class Change : unsigned char { None, Unknown, Taken, Posed, ToTake };
    /// Of a block's bodies, a bit for each.
    using Some = std::uint32_t;
    struct Block {
        FlightLanes lanes{};
        Some taken = 0; ///< drawn from lanes
        Some written = 0; ///< their matrices stay as they are
        Some posed = 0; ///< by poseAt(), or with other impacts
        Some to_take = 0; ///< of these, as soon as they need no push

        /// How the body in this lane is drawn; None: it stays as it is.
        void set(std::size_t lane, Change change);
    };
    [[nodiscard]] static bool canBeTaken(const Phase& phase);
    Change look(std::size_t slot, const BodySlot& body, double t);
    void takeFlights(std::size_t index, double t, LargeArray<BodySlot>& bodies);
    /// Impacts that are worked out together.
    struct Impacts {
        ImpactLanes lanes;
        std::array<std::size_t, kLanes> slots{}; ///< whose they are
        std::size_t count = 0;
    };
    void writeFlights(std::size_t index, const Falling& falling, double t);
    void writePosed(std::span<const std::uint32_t> slots, double t, const LargeArray<BodySlot>& bodies);
    void writeBlocks(std::size_t begin, std::size_t end, double t, LargeArray<BodySlot>& bodies);
    void writeImpacts(double t, Impacts& impacts);
    void writePose(std::size_t slot, const BodySlot& body, double t);

    Vec3 gravity_{0.0}; ///< that of the flights in lanes
    /// By slot, of whole blocks; what has changed is looked at when the block is drawn. Empty before the first use.
    LargeArray<Change> changed_;
    LargeArray<Block> blocks_;
    LargeArray<float> matrices_; ///< of whole blocks
};

} // namespace elastoon
