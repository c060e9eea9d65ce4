// What is true of closest points by other means, for tests and fuzz targets.
#pragma once

#include "closest.h"
#include "elastoon/phase.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

namespace elastoon {

inline PosedShape posed(const ShapePtr& shape, const Quat& rotation, double stretch, const Vec3& position) {
    return {shape.get(), linearOf({position, rotation, stretch}), position};
}

inline Vec3 worldOf(const PosedShape& body, const Vec3& point) {
    return body.position + body.linear * point;
}

/// Longest half axis of the posed body, about.
inline double sizeOf(const PosedShape& body) {
    double size = 0.0;
    for (const Vec3& vertex : body.shape->vertices()) {
        size = std::max(size, glm::length(body.linear * vertex));
    }
    return size;
}

inline double sizeOf(const PosedShape& a, const PosedShape& b) {
    return std::max(sizeOf(a), sizeOf(b));
}

/// Furthest along the direction, from the body's own position; over all vertices.
inline double reachOf(const PosedShape& body, const Vec3& direction) {
    double reach = -std::numeric_limits<double>::infinity();
    for (const Vec3& vertex : body.shape->vertices()) {
        reach = std::max(reach, glm::dot(direction, body.linear * vertex));
    }
    return reach;
}

/// Gap of the bodies between planes across the normal (unit, from b towards a).
inline double gapAcross(const PosedShape& a, const PosedShape& b, const Vec3& normal) {
    return glm::dot(normal, a.position - b.position) - reachOf(a, -normal) - reachOf(b, normal);
}

/// Across the posed face, outward, as long as twice its area.
inline Vec3 areaOf(const PosedShape& body, std::size_t face) {
    const auto loop = body.shape->face(face);
    const auto vertices = body.shape->vertices();
    Vec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
        sum += glm::cross(body.linear * (vertices[loop[i]] - vertices[loop[0]]),
                          body.linear * (vertices[loop[i + 1]] - vertices[loop[0]]));
    }
    return sum;
}

inline Vec3 faceNormal(const PosedShape& body, std::size_t face) {
    return glm::normalize(areaOf(body, face));
}

/// Three volumes by the surface: about the radius of the ball within.
inline double thicknessOf(const PosedShape& body) {
    double area = 0.0;
    for (std::size_t face = 0; face < body.shape->faceCount(); ++face) {
        area += 0.5 * glm::length(areaOf(body, face));
    }
    return 3.0 * body.shape->volume() * glm::determinant(body.linear) / area;
}

/// How far the point is outside the body's furthest face plane; negative inside. The planes of slivers are left out:
/// hulls are convex to 1e-11 of the thickness, and far from a sliver its plane makes much of that.
inline double outside(const PosedShape& body, const Vec3& point) {
    const double narrow = 1e-2 * thicknessOf(body);
    const auto vertices = body.shape->vertices();
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t face = 0; face < body.shape->faceCount(); ++face) {
        const auto loop = body.shape->face(face);
        const Vec3 area = areaOf(body, face);
        const double length = glm::length(area);
        double longest = 0.0;
        for (const std::uint32_t corner : loop) {
            longest = std::max(longest, glm::length(body.linear * (vertices[corner] - vertices[loop[0]])));
        }
        if (length > narrow * longest) {
            const Vec3 corner = body.linear * vertices[loop[0]];
            most = std::max(most, glm::dot(area / length, (point - body.position) - corner));
        }
    }
    return most;
}

/// std::to_string would show small numbers as zero.
inline std::string shown(double number) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", number);
    return text.data();
}

/// Whether the answer proves itself: the points are of the bodies and as far apart as two parallel planes between the
/// bodies are; or the witness is in both. What is wrong, or empty.
inline std::string flawOf(const Closest& closest, const PosedShape& a, const PosedShape& b, double tolerance) {
    if (closest.overlap) {
        const double out = std::max(outside(a, closest.witness), outside(b, closest.witness));
        return out <= tolerance ? "" : "witness is outside by " + shown(out);
    }
    if (std::fabs(glm::length(closest.normal) - 1.0) > 1e-12) {
        return "normal is not unit";
    }
    const double off = std::max(outside(a, closest.point_a), outside(b, closest.point_b));
    if (off > tolerance) {
        return "a point is off its body by " + shown(off);
    }
    const double between = glm::length(closest.point_a - closest.point_b);
    if (std::fabs(between - closest.distance) > tolerance) {
        return "the points are not at the distance";
    }
    const double short_by = closest.distance - gapAcross(a, b, closest.normal);
    return std::fabs(short_by) <= tolerance ? "" : "no planes prove the distance: short by " + shown(short_by);
}

/// One of the 24 rotations of the cube, as a matrix of exact numbers.
inline Mat3 latticeRotation(int index) {
    constexpr std::array<std::array<int, 3>, 6> kOrders{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    const auto& order = kOrders[static_cast<std::size_t>(index / 4)];
    Mat3 turned(0.0);
    turned[order[0]][0] = index % 2 == 0 ? 1.0 : -1.0;
    turned[order[1]][1] = index / 2 % 2 == 0 ? 1.0 : -1.0;
    turned[order[2]][2] = 1.0;
    turned[order[2]][2] = glm::determinant(turned);
    return turned;
}

} // namespace elastoon
