// See oracle_solids.h.
#include "oracle_solids.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace elastoon {

namespace {

Real dot(const RealVec& a, const RealVec& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

RealVec minus(const RealVec& a, const RealVec& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

RealVec cross(const RealVec& a, const RealVec& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Unit; zero where the vector is.
RealVec unit(const RealVec& a) {
    const Real length = std::sqrt(dot(a, a));
    return length > 0 ? RealVec{a[0] / length, a[1] / length, a[2] / length} : RealVec{0, 0, 0};
}

std::vector<RealVec> normalsOf(const PosedWitness& posed) {
    std::vector<RealVec> normals;
    for (const auto& face : posed.solid->faces) {
        RealVec sum{0, 0, 0};
        for (std::size_t i = 1; i + 1 < face.size(); ++i) {
            const RealVec part = cross(minus(posed.vertices[face[i]], posed.vertices[face[0]]),
                                       minus(posed.vertices[face[i + 1]], posed.vertices[face[0]]));
            sum = {sum[0] + part[0], sum[1] + part[1], sum[2] + part[2]};
        }
        normals.push_back(unit(sum));
    }
    return normals;
}

/// How far b lies beyond a in direction `axis`.
Real gapAlong(const PosedWitness& a, const PosedWitness& b, const RealVec& axis) {
    Real furthest_a = -std::numeric_limits<Real>::infinity();
    Real nearest_b = std::numeric_limits<Real>::infinity();
    for (const RealVec& vertex : a.vertices) {
        furthest_a = std::max(furthest_a, dot(axis, vertex));
    }
    for (const RealVec& vertex : b.vertices) {
        nearest_b = std::min(nearest_b, dot(axis, vertex));
    }
    return nearest_b - furthest_a;
}

/// The widest gap along a face normal of a, if it is above `best`. No axis has the two further apart than any of their
/// points are along it: most axes are dropped by one point of each.
Real widestAcrossFaces(const PosedWitness& a, const std::vector<RealVec>& normals, const PosedWitness& b, Real best) {
    RealVec point = b.vertices.front();
    for (std::size_t i = 0; i < normals.size(); ++i) {
        if (dot(normals[i], minus(point, a.vertices[a.solid->faces[i].front()])) > best) {
            best = std::max(best, gapAlong(a, b, normals[i]));
            point = *std::min_element(b.vertices.begin(), b.vertices.end(), [&](const RealVec& p, const RealVec& q) {
                return dot(normals[i], p) < dot(normals[i], q);
            });
        }
    }
    return best;
}

/// The arcs between the normals (a1, a2) and between (-b1, -b2) cross on the sphere.
bool arcsCross(const RealVec& a1, const RealVec& a2, const RealVec& b1, const RealVec& b2) {
    const RealVec c{-b1[0], -b1[1], -b1[2]};
    const RealVec d{-b2[0], -b2[1], -b2[2]};
    const RealVec ab = cross(a1, a2);
    const RealVec cd = cross(c, d);
    const Real cba = dot(c, ab);
    const Real dba = dot(d, ab);
    const Real adc = dot(a1, cd);
    const Real bdc = dot(a2, cd);
    return cba * dba < 0 && adc * bdc < 0 && cba * bdc > 0;
}

} // namespace

SolidWitness::SolidWitness(const Shape& shape) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> left_of;
    for (std::size_t i = 0; i < shape.faceCount(); ++i) {
        const auto loop = shape.face(i);
        faces.emplace_back(loop.begin(), loop.end());
        for (std::size_t j = 0; j < loop.size(); ++j) {
            left_of[{loop[j], loop[(j + 1) % loop.size()]}] = i;
        }
    }
    for (const auto& [ends, left] : left_of) {
        const auto back = left_of.find({ends.second, ends.first});
        if (ends.first < ends.second && back != left_of.end()) {
            edges.push_back({ends.first, ends.second, left, back->second});
        }
    }
}

Real separationBySat(const PosedWitness& a, const PosedWitness& b) {
    const std::vector<RealVec> normals_a = normalsOf(a);
    const std::vector<RealVec> normals_b = normalsOf(b);
    Real best = -std::numeric_limits<Real>::infinity();
    best = widestAcrossFaces(a, normals_a, b, best);
    best = widestAcrossFaces(b, normals_b, a, best);
    for (const auto& edge_a : a.solid->edges) {
        const RealVec along_a = minus(a.vertices[edge_a.head], a.vertices[edge_a.tail]);
        for (const auto& edge_b : b.solid->edges) {
            if (!arcsCross(normals_a[edge_a.left], normals_a[edge_a.right], normals_b[edge_b.left],
                           normals_b[edge_b.right])) {
                continue;
            }
            RealVec axis = unit(cross(along_a, minus(b.vertices[edge_b.head], b.vertices[edge_b.tail])));
            const RealVec outward = normals_a[edge_a.left];
            if (dot(axis, outward) + dot(axis, normals_a[edge_a.right]) < 0) {
                axis = {-axis[0], -axis[1], -axis[2]};
            }
            // No axis has the two further apart than any of their points are along it.
            const Real most = dot(axis, minus(b.vertices[edge_b.tail], a.vertices[edge_a.tail]));
            if (dot(axis, axis) > 0.5L && most > best) {
                best = std::max(best, gapAlong(a, b, axis));
            }
        }
    }
    return best;
}

RealMat rotationOf(const Quat& q) {
    const Real w = q.w;
    const Real x = q.x;
    const Real y = q.y;
    const Real z = q.z;
    return {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
             {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
             {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}

RealVec product(const RealMat& m, const RealVec& x) {
    return {dot(m[0], x), dot(m[1], x), dot(m[2], x)};
}

std::vector<RealVec> posedVertices(const Shape& shape, const Pose& pose) {
    const RealMat rotation = rotationOf(pose.orientation);
    const Real across = 1 / std::sqrt(static_cast<Real>(pose.stretch));
    const RealVec position{pose.position.x, pose.position.y, pose.position.z};
    std::vector<RealVec> vertices;
    vertices.reserve(shape.vertices().size());
    for (const Vec3& vertex : shape.vertices()) {
        RealVec point =
            product(rotation, {vertex.x * static_cast<Real>(pose.stretch), vertex.y * across, vertex.z * across});
        for (std::size_t axis = 0; axis < 3; ++axis) {
            point[axis] += position[axis];
        }
        vertices.push_back(point);
    }
    return vertices;
}

Real boxGap(const std::vector<RealVec>& a, const std::vector<RealVec>& b) {
    Real gap = -std::numeric_limits<Real>::infinity();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto less = [axis](const RealVec& p, const RealVec& q) { return p[axis] < q[axis]; };
        const auto [low_a, high_a] = std::minmax_element(a.begin(), a.end(), less);
        const auto [low_b, high_b] = std::minmax_element(b.begin(), b.end(), less);
        gap = std::max({gap, (*low_b)[axis] - (*high_a)[axis], (*low_a)[axis] - (*high_b)[axis]});
    }
    return gap;
}

} // namespace elastoon
