// The hull as triangles, exactly convex: the first half of convexHull(). docs/hull.md.
#pragma once

#include "orient.h"

#include <array>
#include <vector>

namespace elastoon {

/// Corners counter-clockwise from outside; neighbors[i] is across the edge corners[i] -> corners[i + 1].
struct Triangle {
    std::array<int, 3> corners{};
    std::array<int, 3> neighbors{};
};

struct TriangleHull {
    std::vector<Triangle> triangles;
    const char* spans = nullptr; ///< what the points span, if not a solid: there are no triangles then
};

/// What all parts of the hull measure by.
struct PointSet {
    std::vector<Vec3> points; ///< coordinates zero, or far from the limits of doubles
    Vec3 extent{0.0};         ///< of the box around them
    double size = 0.0;        ///< its longest edge
    double rounding = 0.0;    ///< how much of a coordinate may be rounding

    [[nodiscard]] const Vec3& at(int i) const { return points[static_cast<std::size_t>(i)]; }
    [[nodiscard]] OrientedPlane planeOf(const Triangle& triangle) const {
        return {at(triangle.corners[0]), at(triangle.corners[1]), at(triangle.corners[2]), extent};
    }
};

/// Closed, no triangle without area, no point of the hull beyond any triangle's plane, all exactly; given points that
/// are beyond planes by no more than two roundings are left out.
[[nodiscard]] TriangleHull triangleHullOf(const PointSet& set);

} // namespace elastoon
