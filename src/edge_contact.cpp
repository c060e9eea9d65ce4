// See edge_contact.h. Seen along the edge the body is flat and the edge a point: two corners of the body's outline on
// either side of the point are moved outwards until the outline's side between them passes over it (the portal of
// line_contact.cpp, one dimension lower). A plane along that side that the solid lies below proves the contact.
#include "edge_contact.h"

#include "contact.h"
#include "support.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace elastoon {

namespace {

constexpr std::size_t kMostEdges = 64;
/// A cosine: of the line of motion and a face's normal.
constexpr double kSteepest = 1e-3;
/// A sine: the surface's plane holds the edge, nearly.
constexpr double kAcross = 1e-3;
/// Times the body's length: the surface's point lies on the edge.
constexpr double kNear = 1e-6;
/// Times the size: rounding.
constexpr double kRounding = 0x1p-48;
constexpr int kMostSteps = 32;

/// The edge that the surface's plane touches at its point.
const Topology::Edge* edgeOf(const Surface& surface, double near) {
    const Shape& solid = *surface.solid;
    const Topology& topology = solid.topology();
    if (!topology.closed || topology.edges.size() > kMostEdges) {
        return nullptr;
    }
    const auto found = std::find_if(topology.edges.begin(), topology.edges.end(), [&](const Topology::Edge& edge) {
        const Vec3& tail = solid.vertices()[edge.tail];
        const Vec3 way = solid.vertices()[edge.head] - tail;
        const double squared = glm::dot(way, way);
        const double rise = glm::dot(way, surface.normal);
        if (rise * rise > kAcross * kAcross * squared) {
            return false;
        }
        const Vec3 off = glm::cross(way, surface.point - tail);
        return glm::dot(off, off) <= near * near * squared;
    });
    return found != topology.edges.end() ? &*found : nullptr;
}

/// A vertex of the body, seen along the edge from its tail: across, and up along the surface's normal.
struct Corner {
    double across = 0.0, up = 0.0;
    Vec3 vertex{0.0};
};

class Outline {
public:
    Outline(const Shape& shape, const Pose& pose, const Vec3& tail, const Vec3& across, const Vec3& up)
        : shape_(shape) {
        const Mat3 linear = linearOf(pose);
        across_ = across * linear;
        up_ = up * linear;
        base_across_ = glm::dot(across, pose.position - tail);
        base_up_ = glm::dot(up, pose.position - tail);
    }
    /// The corner furthest in this direction.
    [[nodiscard]] Corner furthest(double across, double up) const {
        const Vec3& vertex = shape_.vertices()[supportOf(shape_, across_ * across + up_ * up)];
        return {base_across_ + glm::dot(across_, vertex), base_up_ + glm::dot(up_, vertex), vertex};
    }

private:
    const Shape& shape_;
    Vec3 across_{0.0}, up_{0.0}; ///< the directions, in the shape's frame
    double base_across_ = 0.0, base_up_ = 0.0;
};

/// Two corners with the edge's point between them, across.
struct Side {
    Corner left, right;
};

std::optional<Side> sideOver(const Outline& outline, double rounding) {
    const Corner lowest = outline.furthest(0.0, -1.0);
    const double way = lowest.across < 0.0 ? 1.0 : -1.0;
    Corner other = outline.furthest(way, -1.0);
    if (!(way * other.across > rounding)) {
        other = outline.furthest(way, 0.0);
    }
    if (!(way * other.across > rounding)) {
        return std::nullopt;
    }
    Side side = lowest.across < 0.0 ? Side{lowest, other} : Side{other, lowest};
    for (int step = 0; step < kMostSteps; ++step) {
        const double run = side.right.across - side.left.across;
        const double rise = side.right.up - side.left.up;
        const Corner next = outline.furthest(rise, -run);
        const double beyond = rise * (next.across - side.left.across) - run * (next.up - side.left.up);
        if (beyond <= rounding * std::sqrt(run * run + rise * rise)) {
            return side;
        }
        (next.across < 0.0 ? side.left : side.right) = next;
    }
    return std::nullopt;
}

} // namespace

namespace {

/// The body comes down on the edge, or beyond it on a face that borders on it, or neither.
std::optional<LineContact> contactAbout(const Topology::Edge& edge, const Surface& surface, const Shape& shape,
                                        const Pose& pose, bool also_on_faces) {
    const Shape& solid = *surface.solid;
    const Vec3& tail = solid.vertices()[edge.tail];
    const Vec3 way = solid.vertices()[edge.head] - tail;
    const double length = glm::length(way);
    const Vec3 along = way / length;
    const Vec3 up = surface.normal - along * glm::dot(along, surface.normal);
    const Vec3 across = glm::cross(up, along);
    const Outline outline(shape, pose, tail, across, up);
    const double size = shape.boundingRadius() * std::max(pose.stretch, 1.0 / std::sqrt(pose.stretch));
    const auto side = sideOver(outline, kRounding * size);
    if (!side) {
        return std::nullopt;
    }
    const double run = side->right.across - side->left.across;
    const double rise = side->right.up - side->left.up;
    const Vec3 normal = up * run - across * rise;
    const auto& normals = solid.topology().face_normals;
    for (const auto& [face, into_face] : {std::pair(edge.left, glm::cross(normals[edge.left], along)),
                                          std::pair(edge.right, glm::cross(along, normals[edge.right]))}) {
        if (glm::dot(normal, into_face) > 0.0) {
            return also_on_faces ? contactOnFace(solid, face, shape, pose, surface.normal) : std::nullopt;
        }
    }
    const double share = -side->left.across / run;
    const double left = glm::dot(along, worldFromShape(pose, side->left.vertex) - tail);
    const double right = glm::dot(along, worldFromShape(pose, side->right.vertex) - tail);
    const double shift = -(side->left.up + share * rise) / glm::dot(up, surface.normal);
    const double at = left + share * (right - left) + shift * glm::dot(along, surface.normal);
    return at > 0.0 && at < length ? std::optional(LineContact{shift, glm::normalize(normal)}) : std::nullopt;
}

/// The edge of this face that the point, seen along its normal, is furthest beyond; null if it is over the face.
const Topology::Edge* edgeBeyond(const Shape& solid, std::size_t face, const Vec3& point) {
    const Vec3& normal = solid.topology().face_normals[face];
    const Topology::Edge* furthest = nullptr;
    double most = 0.0;
    for (const Topology::Edge& edge : solid.topology().edges) {
        const double inwards = edge.left == face ? 1.0 : edge.right == face ? -1.0 : 0.0;
        const Vec3& tail = solid.vertices()[edge.tail];
        const Vec3 way = glm::normalize(solid.vertices()[edge.head] - tail);
        const double beyond = -inwards * glm::dot(glm::cross(normal, way), point - tail);
        if (beyond > most) {
            most = beyond;
            furthest = &edge;
        }
    }
    return furthest;
}

} // namespace

std::optional<LineContact> contactOnFace(const Shape& solid, std::size_t face, const Shape& shape, const Pose& pose,
                                         const Vec3& direction) {
    const Vec3& normal = solid.topology().face_normals[face];
    const double cosine = glm::dot(normal, direction);
    if (cosine < kSteepest) {
        return std::nullopt;
    }
    const Vec3 lowest = furthestPoint(shape, pose, -normal);
    const double shift = glm::dot(normal, solid.vertices()[solid.face(face)[0]] - lowest) / cosine;
    return isOverFace(solid, face, lowest + direction * shift) ? std::optional(LineContact{shift, normal})
                                                               : std::nullopt;
}

std::optional<LineContact> contactOnEdge(const Surface& surface, const Shape& shape, const Pose& pose) {
    const Topology::Edge* edge = edgeOf(surface, kNear * shape.length());
    return edge != nullptr ? contactAbout(*edge, surface, shape, pose, false) : std::nullopt;
}

std::optional<LineContact> contactOffFace(const Surface& surface, const Shape& shape, const Pose& pose) {
    const Topology::Edge* edge = edgeOf(surface, kNear * shape.length());
    if (const auto face = edge == nullptr ? faceOf(surface) : std::nullopt) {
        edge = edgeBeyond(*surface.solid, *face, furthestPoint(shape, pose, -surface.normal));
    }
    const auto contact = edge != nullptr ? contactAbout(*edge, surface, shape, pose, true) : std::nullopt;
    return contact ? contact
                   : contactAlong({&shape, linearOf(pose), pose.position}, {surface.solid.get(), Mat3(1.0), Vec3(0.0)},
                                  surface.normal);
}

} // namespace elastoon
