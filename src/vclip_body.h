// A posed body as V-Clip looks at it: its features in the frame that both bodies share, and segments cut by planes.
#pragma once

#include "closest.h"

#include <algorithm>
#include <span>

namespace elastoon {

/// A body in the frame that both share. Every plane and slope has one expression, so that it rounds one way.
struct VclipBody {
    const PosedShape& posed;
    const Topology& topology;
    std::span<const Vec3> vertices;
    Vec3 offset;
    Mat3 cofactor;

    VclipBody(const PosedShape& shape, const Vec3& at)
        : posed(shape), topology(shape.shape->topology()), vertices(shape.shape->vertices()), offset(at) {
        const Mat3& m = shape.linear;
        cofactor = {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
    }

    [[nodiscard]] Vec3 at(std::uint32_t vertex) const { return offset + posed.linear * vertices[vertex]; }
    [[nodiscard]] const Topology::Edge& ends(std::uint32_t edge) const { return topology.edges[edge]; }
    [[nodiscard]] Vec3 along(std::uint32_t edge) const {
        return posed.linear * (vertices[ends(edge).head] - vertices[ends(edge).tail]);
    }
    /// Away from the vertex, one of the edge's ends.
    [[nodiscard]] Vec3 awayFrom(std::uint32_t vertex, std::uint32_t edge) const {
        const Vec3 w = along(edge);
        return ends(edge).tail == vertex ? w : -w;
    }
    /// Outward, not unit.
    [[nodiscard]] Vec3 normal(std::uint32_t face) const { return cofactor * topology.face_normals[face]; }
    /// Of the plane through the edge that parts the edge's region from the face's; towards the edge's.
    [[nodiscard]] Vec3 outOf(std::uint32_t face, std::uint32_t edge) const {
        const Vec3 c = glm::cross(along(edge), normal(face));
        return ends(edge).left == face ? c : -c;
    }
    [[nodiscard]] double height(std::uint32_t face, const Vec3& normal_of_face, const Vec3& point) const {
        return glm::dot(normal_of_face, point - at(posed.shape->face(face)[0]));
    }
};

/// A segment, and what is left of it between planes.
struct VclipSegment {
    Vec3 tail, head, along;
    double low = 0.0, high = 1.0;
    bool has_low = false, has_high = false;
    Feature low_neighbor, high_neighbor;

    VclipSegment(const VclipBody& body, std::uint32_t edge)
        : tail(body.at(body.ends(edge).tail)), head(body.at(body.ends(edge).head)), along(body.along(edge)) {}

    [[nodiscard]] Vec3 at(double l) const { return tail + l * along; }
    [[nodiscard]] bool empty() const { return low > high; }

    /// By a plane through `base` with the inner side along `inward`. False where all is outside.
    bool by(const Vec3& inward, const Vec3& base, const Feature& neighbor) {
        const double of_tail = glm::dot(inward, tail - base);
        const double of_head = glm::dot(inward, head - base);
        if (of_tail < 0.0) {
            if (of_head < 0.0) {
                return false;
            }
            const double l = of_tail / (of_tail - of_head);
            if (l > low || !has_low) {
                low = std::max(low, l);
                has_low = true;
                low_neighbor = neighbor;
            }
        } else if (of_head < 0.0) {
            const double l = of_tail / (of_tail - of_head);
            if (l < high || !has_high) {
                high = std::min(high, l);
                has_high = true;
                high_neighbor = neighbor;
            }
        }
        return true;
    }
};

struct SegmentPair {
    double s = 0.0, t = 0.0;
    Vec3 across{0.0}; ///< cross product of the two
    Vec3 difference{0.0};
};

/// Nearest points p + s u and q + t v.
[[nodiscard]] inline SegmentPair nearestOfSegments(const Vec3& p, const Vec3& u, const Vec3& q, const Vec3& v) {
    SegmentPair found;
    const Vec3 r = q - p;
    const double uu = glm::dot(u, u);
    const double vv = glm::dot(v, v);
    found.across = glm::cross(u, v);
    const double area = glm::dot(found.across, found.across);
    const bool parallel = !(area > 1e-28 * uu * vv);
    found.s = parallel ? 0.0 : std::clamp(glm::dot(glm::cross(r, v), found.across) / area, 0.0, 1.0);
    found.t = std::clamp(glm::dot(v, found.s * u - r) / vv, 0.0, 1.0);
    found.s = std::clamp(glm::dot(u, r + found.t * v) / uu, 0.0, 1.0);
    found.t = std::clamp(glm::dot(v, found.s * u - r) / vv, 0.0, 1.0);
    found.difference = (p + found.s * u) - (q + found.t * v);
    return found;
}

} // namespace elastoon
