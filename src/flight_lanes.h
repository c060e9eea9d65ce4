// Flights side by side. See lanes.h.
#pragma once

#include "elastoon/phase.h"
#include "lanes.h"

#include <array>

namespace elastoon {

/// What flights that have no ease are made from, besides the gravity: numbers of as many as are in a row.
template <std::size_t kCount>
struct FlightRows {
    using Row = std::array<double, kCount>;
    Row start, reversal_speed, max_stretch, stretch_rate;
    std::array<Row, 3> position, velocity;
    std::array<Row, 4> orientation; ///< w, x, y, z
};

/// A row of eight lanes is a line of the cache.
struct FlightLanes {
    static constexpr std::size_t kTogether = 8;
    using Eight = FlightRows<kTogether>;
    alignas(64) std::array<Eight, kLanes / kTogether> eights{};

    void set(std::size_t lane, double began, const Flight& flight);
    /// The flight that was set, to the bit; it has no ease.
    void get(std::size_t lane, const Vec3& gravity, Flight& flight) const;
};

/// What all flights in lanes have of the gravity.
struct Falling {
    explicit Falling(const Vec3& gravity);

    Vec3 gravity, up;
    double pull;
    double turns; ///< 1; 0 where nothing falls, so nothing turns
};

/// What completeFlight(), unpushedPose() and linearOf() do, in the same order.
void poseFlights(const FlightLanes& in, const Falling& falling, double t, Columns& out);

} // namespace elastoon
