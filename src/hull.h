// Convex hull of points, with coplanar triangles merged into polygons. docs/hull.md.
#pragma once

#include "elastoon/math.h"
#include "elastoon/result.h"

#include <cstdint>
#include <span>
#include <vector>

namespace elastoon {

/// A convex solid. Face i has the vertices face_vertices[face_begin[i] .. face_begin[i + 1]], counter-clockwise from
/// outside.
struct Polytope {
    std::vector<Vec3> vertices;
    std::vector<std::uint32_t> face_vertices;
    std::vector<std::uint32_t> face_begin{0};
};

/// The hull of finite points. Faces whose corners lie within 1e-11 of the thickness of one plane, or within the
/// rounding of the coordinates, are one face. Closed, and convex up to a few times that; the vertices are given points,
/// in the given order. Error: fewer than four points, coordinates not finite or beyond 1e9, all equal, on a line, or on
/// a plane.
[[nodiscard]] Result<Polytope> convexHull(std::span<const Vec3> points);

struct MassCenter {
    double volume = 0.0;
    Vec3 centroid{0.0};
};
/// Volume and volume centroid.
[[nodiscard]] MassCenter massCenterOf(const Polytope& polytope);

} // namespace elastoon
