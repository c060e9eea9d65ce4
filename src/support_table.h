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
#if defined(__wasm__)
        return cell[firstHighest(heightsOf(vertices, cell, direction))];
#else
        double highest = glm::dot(direction, vertices[best]);
        for (std::size_t i = 1; i < cell.size(); ++i) {
            const double height = glm::dot(direction, vertices[cell[i]]);
            best = height > highest ? cell[i] : best;
            highest = height > highest ? height : highest;
        }
        return best;
#endif
    }
    /// `direction` . that vertex.
    [[nodiscard]] double highest(std::span<const Vec3> vertices, const Topology& topology,
                                 const Vec3& direction) const {
        const Cell& cell = cells_[cellOf(direction)];
        if (cell[1] == Topology::kNone) {
            return glm::dot(direction, vertices[climb(vertices, topology, direction, cell[0])]);
        }
        const std::array<double, 4> heights = heightsOf(vertices, cell, direction);
        return std::max(std::max(heights[0], heights[1]), std::max(heights[2], heights[3]));
    }

private:
    /// All four are looked at, without a branch: fewer are filled up with the last one. Where there are more, the
    /// second is kNone, and a climb begins at the first.
    using Cell = std::array<std::uint32_t, 4>;
    [[nodiscard]] std::size_t cellOf(const Vec3& direction) const;
    [[nodiscard]] static std::array<double, 4> heightsOf(std::span<const Vec3> vertices, const Cell& cell,
                                                         const Vec3& direction) {
        const auto height = [&](std::size_t i) { return glm::dot(direction, vertices[cell[i]]); };
        return {height(0), height(1), height(2), height(3)};
    }
    [[nodiscard]] static std::size_t firstHighest(const std::array<double, 4>& heights);

    std::int32_t side_ = 1; ///< of the cube, in cells
    std::vector<Cell> cells_;
};

// Which way the directions go nobody can foresee, and WebAssembly's choice between two numbers is a branch: there they
// are made by comparing, counting and looking up, which gives the same.
inline std::size_t SupportTable::firstHighest(const std::array<double, 4>& heights) {
    using Two [[gnu::vector_size(16)]] = double;
    const Two a{heights[0], heights[1]};
    const Two b{heights[2], heights[3]};
    const Two c = a > b ? a : b;
    const Two d{c[1], c[0]};
    const double highest = (c > d ? c : d)[0];
    const bool not_0 = heights[0] != highest;
    const bool not_1 = not_0 & (heights[1] != highest);
    const bool not_2 = not_1 & (heights[2] != highest);
    return static_cast<std::size_t>(not_0) + static_cast<std::size_t>(not_1) + static_cast<std::size_t>(not_2);
}

inline std::size_t SupportTable::cellOf(const Vec3& direction) const {
    const double x = std::fabs(direction.x);
    const double y = std::fabs(direction.y);
    const double z = std::fabs(direction.z);
#if defined(__wasm__)
    const bool along_y = (y > x) & (y >= z);
    const bool along_z = (z > x) & !along_y;
    const std::size_t axis = static_cast<std::size_t>(along_y) + 2 * static_cast<std::size_t>(along_z);
    const std::array<double, 5> parts{direction.x, direction.y, direction.z, direction.x, direction.y};
    const double main = parts[axis];
    const double first = parts[axis + 1];
    const double second = parts[axis + 2];
    const double largest = std::fabs(main);
#else
    const bool along_y = y > x && y >= z;
    const bool along_z = z > x && !along_y;
    const std::size_t axis = along_y ? 1 : along_z ? 2 : 0;
    const double largest = along_y ? y : along_z ? z : x;
    const double main = along_y ? direction.y : along_z ? direction.z : direction.x;
    const double first = along_y ? direction.z : along_z ? direction.x : direction.y;
    const double second = along_y ? direction.x : along_z ? direction.y : direction.z;
#endif
    if (!(largest > 0.0)) {
        return 0;
    }
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
