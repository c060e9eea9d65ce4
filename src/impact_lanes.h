// Impacts on what stands still, side by side. See lanes.h.
#pragma once

#include "elastoon/phase.h"
#include "lanes.h"

#include <array>

namespace elastoon {

/// What the poses of impacts that are kept clear of nothing are made from.
struct ImpactLanes {
    std::array<const Shape*, kLanes> shapes{};
    std::array<const Surface*, kLanes> surfaces{};
    Row begun{}, s_in{}, s_mid{}, s_out{}, omega_in{}, omega_out{}, t_in{}, t_out{};
    Row turn_angle{}, turn_from{}, smooth{}; ///< smooth: 1, else 0
    std::array<Row, 3> point{}, normal{}, contact{}, turn_axis{}, skims{};
    std::array<Row, 4> orientation{}; ///< w, x, y, z
    std::array<Row, 3> origin{}; ///< of the surface's frame; likewise
    std::array<Row, 4> frame{};

    /// Whether poses of this phase can be worked out here.
    [[nodiscard]] static bool fits(const Phase& phase);
    void set(std::size_t lane, const Impact& impact, const Shape& shape);
};

/// What impactPose() and linearOf() do, in the same order; of the first `count` lanes.
void poseImpacts(const ImpactLanes& in, std::size_t count, double t, Columns& out);

} // namespace elastoon
