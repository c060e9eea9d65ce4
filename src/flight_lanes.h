// Flights side by side. See lanes.h.
#pragma once

#include "elastoon/phase.h"
#include "lanes.h"

#include <array>

namespace elastoon {

/// What the poses of flights that need no push and have no ease are made from.
struct FlightLanes {
    Row start, climb, across, reversal_speed, stretch_rate, max_stretch;
    Row first_up, first_across; ///< the heading at the start
    std::array<Row, 3> position, velocity, axis;
    std::array<Row, 4> orientation; ///< w, x, y, z

    void set(std::size_t lane, const Phase& phase);
};

/// What unpushedPose() and linearOf() do, in the same order.
void poseFlights(const FlightLanes& in, const Vec3& gravity, double t, Columns& out);

} // namespace elastoon
