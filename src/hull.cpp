// See hull.h: the points are measured, made triangles by quickhull.h and polygons by hull_merge.h.
#include "hull.h"

#include "elastoon/shape.h"
#include "hull_merge.h"
#include "quickhull.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace elastoon {

namespace {

/// Corners within this share of the hull's thickness of a plane are on it.
constexpr double kCoplanar = 1e-11;
/// Thinner than this share of the size is flat.
constexpr double kFlat = 1e-10;
/// How much of the largest coordinate may be rounding: what a rotation of given points leaves.
constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
/// Each pass leaves corners out, so few are enough; where more would be needed the corners stay.
constexpr int kMostPasses = 12;
/// A pass that takes off more than this many times the play, all over the surface, has gone wrong and is not used.
constexpr double kMostLoss = 2.0;

/// The points by a power of two that brings their size near 1. That and the loss of digits below 1e-48 of it (they
/// would come near the smallest doubles in products) are all that is changed.
PointSet measure(std::span<const Vec3> points, const Vec3& low, const Vec3& high, double size) {
    double scale = 1.0;
    for (; size * scale < 1.0; scale *= 2.0) {
    }
    for (; size * scale >= 2.0; scale *= 0.5) {
    }
    PointSet set;
    set.extent = (high - low) * scale;
    set.size = size * scale;
    double largest = 0.0;
    set.points.reserve(points.size());
    for (const Vec3& point : points) {
        Vec3 scaled = point * scale;
        for (int axis = 0; axis < 3; ++axis) {
            const double magnitude = std::fabs(scaled[axis]);
            scaled[axis] = magnitude < 1e-48 ? 0.0 : scaled[axis];
            largest = std::max(largest, magnitude);
        }
        set.points.push_back(scaled);
    }
    set.rounding = kRounding * largest;
    return set;
}

struct Bulk {
    double volume = 0.0;
    double area = 0.0;

    /// No less than the radius of the largest ball inside, which it is close to.
    [[nodiscard]] double thickness() const { return 3.0 * volume / area; }
};

Bulk bulkOf(const PointSet& set, const std::vector<Triangle>& triangles) {
    const Vec3 base = set.at(triangles.front().corners[0]);
    Bulk bulk;
    for (const Triangle& triangle : triangles) {
        const OrientedPlane plane = set.planeOf(triangle);
        bulk.volume -= plane.valueAt(base) / 6.0;
        bulk.area += 0.5 * plane.length();
    }
    return bulk;
}

PointSet partOf(const PointSet& set, const std::vector<int>& indices) {
    PointSet part{{}, set.extent, set.size, set.rounding};
    part.points.reserve(indices.size());
    for (const int index : indices) {
        part.points.push_back(set.at(index));
    }
    return part;
}

/// The loops as a polytope; number[i] is the place of the set's point i among those that were given.
Polytope compact(std::span<const Vec3> given, const std::vector<int>& number, const HullFaces& faces) {
    Polytope polytope;
    std::vector<std::uint32_t> vertex_of(number.size(), 0);
    for (std::size_t i = 0; i < number.size(); ++i) {
        if (faces.uses[i] > 0) {
            vertex_of[i] = static_cast<std::uint32_t>(polytope.vertices.size());
            polytope.vertices.push_back(given[static_cast<std::size_t>(number[i])]);
        }
    }
    for (const auto& loop : faces.loops) {
        for (const int corner : loop) {
            polytope.face_vertices.push_back(vertex_of[static_cast<std::size_t>(corner)]);
        }
        polytope.face_begin.push_back(static_cast<std::uint32_t>(polytope.face_vertices.size()));
    }
    return polytope;
}

std::size_t cornerCount(const PointSet& set, const std::vector<Triangle>& triangles) {
    std::vector<bool> is_corner(set.points.size(), false);
    for (const Triangle& triangle : triangles) {
        for (const int corner : triangle.corners) {
            is_corner[static_cast<std::size_t>(corner)] = true;
        }
    }
    return static_cast<std::size_t>(std::count(is_corner.begin(), is_corner.end(), true));
}

/// Merges faces and leaves out the corners that are not needed, until all are.
Polytope simplified(std::span<const Vec3> given, PointSet set, std::vector<Triangle> triangles, double play) {
    std::vector<int> number(set.points.size());
    for (std::size_t i = 0; i < number.size(); ++i) {
        number[i] = static_cast<int>(i);
    }
    HullFaces faces = facesOf(set, triangles, play);
    Bulk bulk = bulkOf(set, triangles);
    for (int pass = 0; pass < kMostPasses; ++pass) {
        const std::vector<int> needed = neededCorners(set, faces, play);
        if (needed.size() == cornerCount(set, triangles) || needed.size() < 4) {
            break;
        }
        PointSet part = partOf(set, needed);
        TriangleHull hull = triangleHullOf(part);
        if (hull.spans != nullptr) {
            break;
        }
        const Bulk left = bulkOf(part, hull.triangles);
        if (left.volume < bulk.volume - kMostLoss * play * bulk.area) {
            break;
        }
        bulk = left;
        std::vector<int> renumbered;
        renumbered.reserve(needed.size());
        for (const int index : needed) {
            renumbered.push_back(number[static_cast<std::size_t>(index)]);
        }
        number = std::move(renumbered);
        set = std::move(part);
        triangles = std::move(hull.triangles);
        faces = facesOf(set, triangles, play);
    }
    cutHollowFaces(set, triangles, play, faces);
    return compact(given, number, faces);
}

} // namespace

Result<Polytope> convexHull(std::span<const Vec3> points) {
    if (points.size() < 4) {
        return Error{"a solid needs at least 4 points, there are " + std::to_string(points.size()), ""};
    }
    Vec3 low = points.front();
    Vec3 high = low;
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            if (!(std::fabs(points[i][axis]) <= Shape::kMaxSize)) {
                return Error{"point " + std::to_string(i) + " is not finite, or further than 1e9 m from the origin",
                             ""};
            }
        }
        low = glm::min(low, points[i]);
        high = glm::max(high, points[i]);
    }
    const double size = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    if (size < Shape::kMinSize) {
        return Error{"the points lie within 1e-9 m of each other; a solid must be larger", ""};
    }
    PointSet set = measure(points, low, high, size);
    TriangleHull hull = triangleHullOf(set);
    if (hull.spans != nullptr) {
        return Error{std::string("the points ") + hull.spans + "; a solid must have a volume", ""};
    }
    const double thickness = bulkOf(set, hull.triangles).thickness();
    if (!(thickness >= kFlat * set.size)) {
        return Error{"the points are too nearly flat for a solid", ""};
    }
    const double play = std::max(kCoplanar * thickness, set.rounding);
    return simplified(points, std::move(set), std::move(hull.triangles), play);
}

MassCenter massCenterOf(const Polytope& polytope) {
    const Vec3 base = polytope.vertices.front();
    Vec3 low = base;
    Vec3 high = base;
    for (const Vec3& vertex : polytope.vertices) {
        low = glm::min(low, vertex);
        high = glm::max(high, vertex);
    }
    double volume = 0.0;
    Vec3 moment(0.0);
    for (std::size_t face = 0; face + 1 < polytope.face_begin.size(); ++face) {
        const std::uint32_t begin = polytope.face_begin[face];
        const auto corner = [&](std::uint32_t i) { return polytope.vertices[polytope.face_vertices[begin + i]]; };
        for (std::uint32_t i = 1; begin + i + 1 < polytope.face_begin[face + 1]; ++i) {
            const Vec3 a = corner(0);
            const Vec3 b = corner(i);
            const Vec3 c = corner(i + 1);
            const double part = -OrientedPlane(a, b, c, high - low).valueAt(base);
            volume += part;
            moment += part * ((a - base) + (b - base) + (c - base));
        }
    }
    return {volume / 6.0, base + moment / (4.0 * volume)};
}

} // namespace elastoon
