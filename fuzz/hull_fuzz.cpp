// libFuzzer target: bytes as points, special values mixed in; a hull is refused with a message, or it is one.
// scripts/fuzz.sh runs it.
#include "bytes.h"
#include "hull.h"
#include "orient.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace elastoon {
namespace {

std::vector<Vec3> pointsFrom(Bytes& bytes) {
    std::vector<Vec3> points;
    const std::uint8_t mode = bytes.next();
    const Vec3 offset = mode % 4 == 3 ? Vec3(1e6 / 3.0, -1e5 / 7.0, 1e6) : Vec3(0.0);
    const Vec3 scale = mode / 4 % 4 == 3 ? Vec3(1.0, 1e-6, 1e-6) : mode / 4 % 4 == 2 ? Vec3(1.0, 1.0, 1e-6) : Vec3(1.0);
    const Quat turn = mode / 16 % 2 == 0 ? kNoRotation : glm::normalize(Quat(0.3, 0.1, -0.7, 0.4));
    while (bytes.any() && points.size() < 400) {
        const double x = coordinate(bytes);
        const double y = coordinate(bytes);
        const double z = coordinate(bytes);
        points.push_back(offset + turn * (scale * Vec3(x, y, z)));
    }
    return points;
}

/// Twice the area, and the value of the plane at p: distance times that.
double valueAt(const Polytope& hull, std::size_t face, const Vec3& p) {
    double value = 0.0;
    const auto at = [&](std::uint32_t i) { return hull.vertices[hull.face_vertices[i]]; };
    const std::uint32_t begin = hull.face_begin[face];
    for (std::uint32_t i = begin + 1; i + 1 < hull.face_begin[face + 1]; ++i) {
        value += orientExactly(at(begin), at(i), at(i + 1), p);
    }
    return value;
}

double areaOf(const Polytope& hull, std::size_t face) {
    Vec3 sum(0.0);
    const auto at = [&](std::uint32_t i) { return hull.vertices[hull.face_vertices[i]]; };
    const std::uint32_t begin = hull.face_begin[face];
    for (std::uint32_t i = begin + 1; i + 1 < hull.face_begin[face + 1]; ++i) {
        sum += glm::cross(at(i) - at(begin), at(i + 1) - at(begin));
    }
    return glm::length(sum);
}

/// Closed and convex: no face has a neighbour's corner above it by more than what merging may do.
void check(const Polytope& hull, const std::vector<Vec3>& points) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> face_at;
    const std::size_t faces = hull.face_begin.size() - 1;
    demand(faces >= 4 && hull.vertices.size() >= 4, "too few faces");
    double area = 0.0;
    for (std::size_t f = 0; f < faces; ++f) {
        const std::uint32_t begin = hull.face_begin[f];
        const std::uint32_t count = hull.face_begin[f + 1] - begin;
        demand(count >= 3, "a face with fewer than three corners");
        for (std::uint32_t i = 0; i < count; ++i) {
            const auto edge = std::pair(hull.face_vertices[begin + i], hull.face_vertices[begin + (i + 1) % count]);
            demand(edge.first < hull.vertices.size(), "a corner that is none");
            demand(face_at.emplace(edge, f).second, "an edge twice");
        }
        area += 0.5 * areaOf(hull, f);
    }
    demand(hull.vertices.size() + faces == face_at.size() / 2 + 2, "Euler's formula");
    const MassCenter mass = massCenterOf(hull);
    demand(mass.volume > 0.0 && std::isfinite(mass.volume), "no volume");
    demand(std::isfinite(glm::length(mass.centroid)), "no centroid");
    double magnitude = 0.0;
    for (const Vec3& point : points) {
        magnitude = std::max({magnitude, std::fabs(point.x), std::fabs(point.y), std::fabs(point.z)});
    }
    const double play = 1e-9 * 3.0 * mass.volume / area + 1e-13 * magnitude;
    for (const auto& [edge, f] : face_at) {
        demand(face_at.count({edge.second, edge.first}) == 1, "an edge with one side");
    }
    for (std::size_t f = 0; f < faces; ++f) {
        const double length = areaOf(hull, f);
        // The planes of the narrowest slivers say nothing far from them.
        if (length < 1e-6 * area) {
            continue;
        }
        for (const Vec3& point : points) {
            demand(valueAt(hull, f, point) <= play * length, "a point outside");
        }
    }
}

} // namespace
} // namespace elastoon

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    elastoon::Bytes bytes(data, size);
    const std::vector<elastoon::Vec3> points = elastoon::pointsFrom(bytes);
    const auto hull = elastoon::convexHull(points);
    if (hull) {
        elastoon::check(hull.value(), points);
    } else {
        elastoon::demand(!hull.error().message.empty(), "an error without a message");
    }
    return 0;
}
