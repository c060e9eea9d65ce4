// Flights side by side. See lanes.h.
#pragma once

#include "elastoon/phase.h"
#include "lanes.h"

#include <array>

namespace elastoon {

/// What flights that have no ease are made from, besides the gravity.
struct FlightLanes {
    Row start{}, reversal_speed{}, max_stretch{}, stretch_rate{};
    std::array<Row, 3> position{}, velocity{};
    std::array<Row, 4> orientation{}; ///< w, x, y, z

    void set(std::size_t lane, double began, const Flight& flight);
    /// The flight that was set, to the bit.
    [[nodiscard]] Flight get(std::size_t lane, const Vec3& gravity) const;
};

/// What completeFlight(), unpushedPose() and linearOf() do, in the same order.
void poseFlights(const FlightLanes& in, const Vec3& gravity, double t, Columns& out);

} // namespace elastoon
