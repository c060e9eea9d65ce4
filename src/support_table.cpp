// See support_table.h. A vertex is out where one neighbour is higher in all four corners of the cell, and so, being
// linear, in all of it. The others hang together.
#include "support_table.h"

#include <array>

namespace elastoon {

namespace {

constexpr std::size_t kCellsOfVertex = 4;
constexpr std::int32_t kLongestSide = 64;
constexpr std::size_t kMostCandidates = 4;
/// Times the length of both: so far from a cell's corner its directions may be rounded.
constexpr double kRounding = 1e-12;

using Corners = std::array<Vec3, 4>;

bool isOut(const Topology& topology, const Corners& corners, std::uint32_t vertex) {
    for (std::uint32_t i = topology.vertex_begin[vertex]; i < topology.vertex_begin[vertex + 1]; ++i) {
        const Vec3& way = topology.ways[i];
        const double least = kRounding * glm::length(way);
        if (std::all_of(corners.begin(), corners.end(),
                        [&](const Vec3& corner) { return glm::dot(way, corner) > least; })) {
            return true;
        }
    }
    return false;
}

/// From the one that is furthest in the middle on; the list may end with one too many.
std::vector<std::uint32_t> candidatesOf(const Topology& topology, const Corners& corners, std::uint32_t furthest) {
    std::vector<std::uint32_t> found{furthest};
    for (std::size_t k = 0; k < found.size(); ++k) {
        for (const std::uint32_t next : topology.neighborsOf(found[k])) {
            if (std::find(found.begin(), found.end(), next) == found.end() && !isOut(topology, corners, next)) {
                found.push_back(next);
                if (found.size() > kMostCandidates) {
                    return found;
                }
            }
        }
    }
    return found;
}

} // namespace

SupportTable::SupportTable(std::span<const Vec3> vertices, const Topology& topology) {
    const auto wanted = kCellsOfVertex * vertices.size();
    while (side_ < kLongestSide && 6 * static_cast<std::size_t>(side_ * side_) < wanted) {
        ++side_;
    }
    const double step = 2.0 / side_;
    std::uint32_t furthest = 0;
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2;
        const auto directionAt = [&](double i, double j) {
            Vec3 direction(0.0);
            direction[axis] = face % 2 == 0 ? 1.0 : -1.0;
            direction[(axis + 1) % 3] = i * step - 1.0;
            direction[(axis + 2) % 3] = j * step - 1.0;
            return direction;
        };
        for (std::int32_t i = 0; i < side_; ++i) {
            for (std::int32_t j = 0; j < side_; ++j) {
                furthest = climb(vertices, topology, directionAt(i + 0.5, j + 0.5), furthest);
                const Corners corners{directionAt(i, j), directionAt(i + 1, j), directionAt(i, j + 1),
                                      directionAt(i + 1, j + 1)};
                std::vector<std::uint32_t> found = candidatesOf(topology, corners, furthest);
                const std::uint32_t start = found.front();
                // In the vertices' order, so that of equal ones always the same is found.
                std::sort(found.begin(), found.end());
                Cell& cell = cells_.emplace_back();
                cell.fill(found.back());
                std::copy_n(found.begin(), std::min(found.size(), cell.size()), cell.begin());
                if (found.size() > kMostCandidates) {
                    cell = {start, Topology::kNone};
                }
            }
        }
    }
}

} // namespace elastoon
