// The matrices of all bodies of a world, for drawing: many flights are worked out at once, and what is still is not
// touched. docs/performance.md.
#pragma once

#include "step.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace elastoon {

/// What the poses of flights that need no push and have no ease are made from, a lane for each body.
struct FlightLanes {
    static constexpr std::size_t kCount = 16;
    using Row = std::array<double, kCount>;
    Row start, climb, across, reversal_speed, stretch_rate, max_stretch;
    std::array<Row, 3> position, velocity, axis;
    std::array<Row, 4> orientation; ///< w, x, y, z
};

class MatrixTable {
public:
    static constexpr std::size_t kFloats = 12;

    /// From the first use on, changes must be told.
    [[nodiscard]] bool inUse() const { return in_use_; }
    /// The body in this slot has begun a phase, has come or has gone.
    void changed(std::size_t slot) { changed_.push_back(static_cast<std::uint32_t>(slot)); }
    void allChanged() { all_changed_ = true; }
    /// 12 floats a slot, as they are at time t: the columns of the linear part, then the position; 0 where there is no
    /// body. The same bits as from poseAt().
    std::span<const float> at(double t, const std::vector<BodySlot>& bodies, const Vec3& gravity,
                              const ParallelFor& parallel_for);

private:
    enum class Kind : std::uint8_t {
        Written, ///< it stays as it is
        Lane, ///< a flight, from `posed_until` on
        Posed, ///< by poseAt()
    };
    struct Block {
        FlightLanes lanes{};
        std::array<double, FlightLanes::kCount> posed_until{}; ///< before it, by poseAt()
        double any_posed_until = 0.0; ///< the latest of them
        std::array<Kind, FlightLanes::kCount> kinds{};
    };
    void take(std::size_t slot, const BodySlot& body, double t);
    void takeChanges(double t, const std::vector<BodySlot>& bodies, const Vec3& gravity);
    template <class What>
    void forPosed(std::size_t index, double t, What&& what) const;
    void writePosed(std::size_t index, double t, const std::vector<BodySlot>& bodies);
    void writeLanes(std::size_t index, double t, std::size_t bodies);
    void writePose(std::size_t slot, const BodySlot& body, double t);

    bool in_use_ = false;
    bool all_changed_ = true;
    Vec3 gravity_{0.0}; ///< that of the flights in lanes
    std::vector<std::uint32_t> changed_;
    std::vector<Block> blocks_;
    std::vector<float> matrices_;
};

} // namespace elastoon
