// The matrices of all bodies of a world, for drawing: many flights are worked out at once, and what is still is not
// touched. docs/performance.md.
#pragma once

#include "flight_lanes.h"
#include "impact_lanes.h"
#include "step.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace elastoon {

class MatrixTable {
public:
    static constexpr std::size_t kFloats = kMatrixFloats;

    /// The body in this slot has begun a phase, has come or has gone. For different slots at the same time, too.
    void changed(std::size_t slot) {
        if (slot < changed_.size()) {
            changed_[slot] = kChanged;
        }
    }
    void allChanged() {
        changed_.clear();
        blocks_.clear();
    }
    /// 12 floats a slot, as they are at time t: the columns of the linear part, then the position; 0 where there is no
    /// body. The same bits as from poseAt().
    std::span<const float> at(double t, const std::vector<BodySlot>& bodies, const Vec3& gravity,
                              const ParallelFor& parallel_for);

private:
    /// Of a block's bodies, a bit for each.
    using Some = std::uint32_t;
    struct Block {
        FlightLanes lanes{};
        std::array<double, kLanes> posed_until{}; ///< before it, by poseAt()
        double any_posed_until = 0.0; ///< the latest of them
        Some flights = 0; ///< in lanes, from `posed_until` on
        Some written = 0; ///< their matrices stay as they are
    };
    void take(std::size_t slot, const BodySlot& body, double t);
    void takeChanges(std::size_t index, double t, const std::vector<BodySlot>& bodies);
    /// Those whose pose is asked for, one by one.
    [[nodiscard]] Some posed(std::size_t index, double t) const;
    /// Impacts that are worked out together.
    struct Impacts {
        ImpactLanes lanes;
        std::array<std::size_t, kLanes> slots{}; ///< whose they are
        std::size_t count = 0;
    };
    void writeFlights(std::size_t index, double t);
    void writePosed(std::size_t index, double t, const std::vector<BodySlot>& bodies, Impacts& impacts);
    void writeImpacts(double t, Impacts& impacts);
    void writePose(std::size_t slot, const BodySlot& body, double t);

    static constexpr unsigned char kChanged = 1;

    Vec3 gravity_{0.0}; ///< that of the flights in lanes
    /// By slot, of whole blocks; what has changed is taken when the block is drawn. Empty before the first use.
    std::vector<unsigned char> changed_;
    std::vector<Block> blocks_;
    std::vector<float> matrices_; ///< of whole blocks
};

} // namespace elastoon
