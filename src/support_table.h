// Which vertices of a shape can be the furthest in a direction, looked up by the direction. docs/vclip.md.
#pragma once

#include "topology.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace elastoon {

/// The directions are parted into cells, squares on the sides of a cube; each has those vertices that are the furthest
/// somewhere in it. What is found depends on the direction alone.
class SupportTable {
public:
    SupportTable() = default;
    /// The topology must be climbable.
    SupportTable(std::span<const Vec3> vertices, const Topology& topology);

    [[nodiscard]] bool empty() const { return cells_.empty(); }
    /// The vertex furthest in `direction` (any length), of those that the table was made from.
    [[nodiscard]] std::uint32_t furthest(std::span<const Vec3> vertices, const Topology& topology,
                                         const Vec3& direction) const {
        const Cell& cell = cells_[cellOf(direction)];
        std::uint32_t best = cell[0];
        if (cell[1] == Topology::kNone) {
            return climb(vertices, topology, direction, best);
        }
        double highest = glm::dot(direction, vertices[best]);
        for (std::size_t i = 1; i < cell.size(); ++i) {
            const double height = glm::dot(direction, vertices[cell[i]]);
            best = height > highest ? cell[i] : best;
            highest = height > highest ? height : highest;
        }
        return best;
    }

private:
    /// All four are looked at, without a branch: fewer are filled up with the last one. Where there are more, the
    /// second is kNone, and a climb begins at the first.
    using Cell = std::array<std::uint32_t, 4>;
    [[nodiscard]] std::size_t cellOf(const Vec3& direction) const;

    std::int32_t side_ = 1; ///< of the cube, in cells
    std::vector<Cell> cells_;
};

inline std::size_t SupportTable::cellOf(const Vec3& direction) const {
    const double x = std::fabs(direction.x);
    const double y = std::fabs(direction.y);
    const double z = std::fabs(direction.z);
    const bool along_y = y > x && y >= z;
    const bool along_z = z > x && !along_y;
    const double largest = along_y ? y : along_z ? z : x;
    const double main = along_y ? direction.y : along_z ? direction.z : direction.x;
    const double first = along_y ? direction.z : along_z ? direction.x : direction.y;
    const double second = along_y ? direction.x : along_z ? direction.y : direction.z;
    if (!(largest > 0.0)) {
        return 0;
    }
    const std::size_t axis = along_y ? 1 : along_z ? 2 : 0;
    const std::size_t face = 2 * axis + (main > 0.0 ? 0 : 1);
    const double half = 0.5 * side_;
    const double scale = half / largest;
    const auto along = [&](double part) {
        return static_cast<std::size_t>(std::clamp(static_cast<std::int32_t>(part * scale + half), 0, side_ - 1));
    };
    const auto side = static_cast<std::size_t>(side_);
    return (face * side + along(first)) * side + along(second);
}

} // namespace elastoon
