// Based on: Wolfe, "Finding the nearest point in a polytope", 1976, for the difference of the two; the nearest point of
// a simplex is found by looking at every face of it.
#include "reference.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace elastoon {

namespace {

using Real = long double;
using RealVec = glm::vec<3, Real, glm::defaultp>;

std::vector<RealVec> posedVertices(const Shape& shape, const Pose& pose) {
    const glm::qua<Real, glm::defaultp> turn(pose.orientation.w, pose.orientation.x, pose.orientation.y,
                                             pose.orientation.z);
    const Real across = 1.0L / std::sqrt(static_cast<Real>(pose.stretch));
    const RealVec scale(pose.stretch, across, across);
    std::vector<RealVec> posed;
    for (const Vec3& vertex : shape.vertices()) {
        posed.push_back(RealVec(pose.position) + turn * (scale * RealVec(vertex)));
    }
    return posed;
}

RealVec furthest(const std::vector<RealVec>& points, const RealVec& direction) {
    Real most = -std::numeric_limits<Real>::infinity();
    RealVec found(0);
    for (const RealVec& point : points) {
        const Real height = glm::dot(point, direction);
        if (height > most) {
            most = height;
            found = point;
        }
    }
    return found;
}

struct Simplex {
    std::array<RealVec, 4> points{};
    std::size_t count = 0;
    RealVec nearest{0}; ///< to the origin
    Real squared = std::numeric_limits<Real>::infinity();
};

/// Keeps the face in `best` if it holds the nearest point yet of its own plane.
void consider(const std::array<RealVec, 4>& points, unsigned face, Simplex& best) {
    Simplex made;
    for (unsigned i = 0; i < 4; ++i) {
        if ((face >> i & 1U) != 0) {
            made.points[made.count++] = points[i];
        }
    }
    const RealVec& a = made.points[0];
    made.nearest = a;
    if (made.count == 2) {
        const RealVec u = made.points[1] - a;
        const Real share = -glm::dot(a, u) / glm::dot(u, u);
        if (!(share >= 0 && share <= 1)) {
            return;
        }
        made.nearest = a + u * share;
    } else if (made.count == 3) {
        const RealVec u = made.points[1] - a;
        const RealVec v = made.points[2] - a;
        const RealVec normal = glm::cross(u, v);
        const Real area = glm::dot(normal, normal);
        const Real share_u = glm::dot(glm::cross(v, a), normal) / area;
        const Real share_v = glm::dot(glm::cross(a, u), normal) / area;
        if (!(share_u >= 0 && share_v >= 0 && share_u + share_v <= 1)) {
            return;
        }
        made.nearest = normal * (glm::dot(a, normal) / area);
    }
    made.squared = glm::dot(made.nearest, made.nearest);
    if (made.squared < best.squared) {
        best = made;
    }
}

} // namespace

ReferenceDistance referenceDistance(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b) {
    const std::vector<RealVec> vertices_a = posedVertices(a, pose_a);
    const std::vector<RealVec> vertices_b = posedVertices(b, pose_b);
    Simplex simplex;
    simplex.points[0] = simplex.nearest = vertices_a[0] - vertices_b[0];
    simplex.count = 1;
    simplex.squared = glm::dot(simplex.nearest, simplex.nearest);
    for (;;) {
        const Real distance = std::sqrt(simplex.squared);
        const RealVec direction = simplex.nearest / distance;
        const RealVec next = furthest(vertices_a, -direction) - furthest(vertices_b, direction);
        const Real slack = distance - glm::dot(next, direction);
        auto points = simplex.points;
        points[simplex.count] = next;
        Simplex best;
        const unsigned newest = 1U << simplex.count;
        for (unsigned face = 1; face < 2 * newest; ++face) {
            if (face != 15) {
                consider(points, face, best);
            }
        }
        if (slack <= 0 || !(best.squared < simplex.squared)) {
            return {static_cast<double>(distance), static_cast<double>(slack)};
        }
        simplex = best;
    }
}

} // namespace elastoon
