// See contact.h. Half-space support; the contact region is found among the vertices that tie for it.
#include "contact.h"

#include "contact_region.h"
#include "edge_contact.h"
#include "rotation.h"
#include "support.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace elastoon {

namespace {

/// Vertices this close to the plane (share of the body's length) lie in the contact region.
constexpr double kFlatness = 1e-9;
/// The same against a solid, where a touch leaves a hair of air.
constexpr double kSolidFlatness = 1e-7;

/// The vertices that are no lower than `least` along `direction`, from the highest on: on a convex shape they hang
/// together. Empty where there are many, or where the shape is too odd for that.
std::vector<std::uint32_t> highestTogether(const Shape& shape, const Vec3& direction, std::uint32_t highest,
                                           double least) {
    constexpr std::size_t kMany = 32;
    const Topology& topology = shape.topology();
    if (!topology.closed || !topology.climbable) {
        return {};
    }
    std::vector<std::uint32_t> found;
    found.reserve(kMany);
    found.push_back(highest);
    for (std::size_t i = 0; i < found.size(); ++i) {
        for (const std::uint32_t next : topology.neighborsOf(found[i])) {
            if (glm::dot(direction, shape.vertices()[next]) >= least &&
                std::find(found.begin(), found.end(), next) == found.end()) {
                found.push_back(next);
            }
        }
        if (found.size() > kMany) {
            return {};
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

/// Vertices of the posed shape that lie furthest in `direction` (world, unit), within `slack` m.
std::vector<Vec3> supportRegion(const Shape& shape, const Pose& pose, const Vec3& direction, double slack) {
    const Vec3 in_shape = scaleOf(pose.stretch) * (glm::conjugate(pose.orientation) * direction);
    const auto vertices = shape.vertices();
    const std::size_t highest = shape.supportVertex(in_shape);
    const double least = glm::dot(in_shape, vertices[highest]) - slack;
    std::vector<Vec3> region;
    region.reserve(4);
    for (const std::uint32_t i : highestTogether(shape, in_shape, static_cast<std::uint32_t>(highest), least)) {
        region.push_back(worldFromShape(pose, vertices[i]));
    }
    if (!region.empty()) {
        return region;
    }
    for (const Vec3& vertex : vertices) {
        if (glm::dot(in_shape, vertex) >= least) {
            region.push_back(worldFromShape(pose, vertex));
        }
    }
    return region;
}

/// Coordinates in a plane.
class Plane {
public:
    Plane(const Vec3& base, const Vec3& normal) : base_(base), u_(anyAcross(normal)), v_(glm::cross(normal, u_)) {}
    [[nodiscard]] std::vector<FlatPoint> flattened(const std::vector<Vec3>& points) const {
        std::vector<FlatPoint> flat;
        flat.reserve(points.size());
        for (const Vec3& point : points) {
            flat.emplace_back(glm::dot(point - base_, u_), glm::dot(point - base_, v_));
        }
        return flat;
    }
    [[nodiscard]] Vec3 lifted(const FlatPoint& point) const { return base_ + u_ * point.first + v_ * point.second; }

private:
    Vec3 base_, u_, v_;
};

} // namespace

// The search takes a multiple of the direction, so that it need not wait for the division.
double reachTowards(const Shape& shape, const Pose& pose, const Vec3& direction) {
    const Vec3 turned = glm::conjugate(pose.orientation) * direction;
    const double root = std::sqrt(pose.stretch);
    const double across = 1.0 / root;
    return across * reachOf(shape, {pose.stretch * root * turned.x, turned.y, turned.z});
}

double gapTo(const Surface& surface, const Shape& shape, const Pose& pose, double t) {
    const Vec3 normal = surface.normalAt(t);
    return glm::dot(normal, pose.position - surface.pointAt(t)) - reachTowards(shape, pose, -normal);
}

bool isOverFace(const Shape& solid, std::size_t face, const Vec3& point) {
    const Vec3& normal = solid.topology().face_normals[face];
    const auto loop = solid.face(face);
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec3& tail = solid.vertices()[loop[i]];
        const Vec3& head = solid.vertices()[loop[i + 1 < loop.size() ? i + 1 : 0]];
        if (glm::dot(glm::cross(normal, head - tail), point - tail) < 0.0) {
            return false;
        }
    }
    return true;
}

Vec3 furthestPoint(const Shape& shape, const Pose& pose, const Vec3& direction) {
    const Vec3 in_shape = scaleOf(pose.stretch) * (glm::conjugate(pose.orientation) * direction);
    return worldFromShape(pose, shape.vertices()[supportOf(shape, in_shape)]);
}

std::optional<std::size_t> faceOf(const Surface& surface) {
    constexpr std::size_t kMostFaces = 64;
    constexpr double kSameNormal = 1e-9;
    const auto& normals = surface.solid->topology().face_normals;
    const auto face = std::find_if(normals.begin(), normals.end(), [&](const Vec3& normal) {
        const Vec3 apart = normal - surface.normal;
        return glm::dot(apart, apart) < kSameNormal * kSameNormal;
    });
    return normals.size() > kMostFaces || face == normals.end()
               ? std::nullopt
               : std::optional(static_cast<std::size_t>(face - normals.begin()));
}

std::optional<double> liftOntoFace(const Surface& surface, const Shape& shape, const Pose& pose_in_frame) {
    const auto face = faceOf(surface);
    const auto contact =
        face ? contactOnFace(*surface.solid, *face, shape, pose_in_frame, surface.normal) : std::nullopt;
    return contact ? std::optional(contact->shift) : std::nullopt;
}

double liftToTouch(const Surface& surface, const Shape& shape, const Pose& pose_in_frame) {
    if (surface.solid) {
        if (const auto lift = liftOntoFace(surface, shape, pose_in_frame)) {
            return *lift;
        }
        if (const auto contact = contactOffFace(surface, shape, pose_in_frame)) {
            return contact->shift;
        }
    }
    return reachTowards(shape, pose_in_frame, -surface.normal) -
           glm::dot(surface.normal, pose_in_frame.position - surface.point);
}

namespace {

/// Of a body and a solid that touch: the middle of what their flat parts share. Where they touch without sharing flat
/// parts (rounding has taken the wrong ones), their nearest points.
Vec3 contactWithSolid(const Shape& shape, const Pose& pose, const Surface& surface, double t) {
    const Vec3 normal = surface.normalAt(t);
    const Pose solid_pose{surface.frame.originAt(t), surface.frame.orientationAt(t), 1.0};
    const double slack = kSolidFlatness * shape.length();
    const std::vector<Vec3> above = supportRegion(shape, pose, -normal, slack);
    const Plane plane(above.front(), normal);
    const std::vector<FlatPoint> upper = flatHull(plane.flattened(above));
    const std::vector<FlatPoint> lower =
        flatHull(plane.flattened(supportRegion(*surface.solid, solid_pose, normal, slack)));
    const FlatPoint middle = middleOf(commonRegion(upper, lower));
    if (isWithin(upper, middle, 10.0 * slack) && isWithin(lower, middle, 10.0 * slack)) {
        return plane.lifted(middle);
    }
    ClosestSeed seed;
    const Vec3 apart = pose.position + normal * (10.0 * slack);
    const Closest closest = closestPoints({&shape, linearOf(pose), apart},
                                          {surface.solid.get(), linearOf(solid_pose), solid_pose.position}, seed);
    return closest.overlap ? plane.lifted(middle) : closest.point_b;
}

/// The vertex of the posed shape that lies furthest in `direction` (world, unit), where no other does within `slack` m:
/// what a body touches with that does not lie flat.
std::optional<Vec3> onlySupport(const Shape& shape, const Pose& pose, const Vec3& direction, double slack) {
    const Vec3 in_shape = scaleOf(pose.stretch) * (glm::conjugate(pose.orientation) * direction);
    const auto vertices = shape.vertices();
    const Topology& topology = shape.topology();
    if (!topology.closed || !topology.climbable) {
        return std::nullopt;
    }
    const auto highest = static_cast<std::uint32_t>(supportOf(shape, in_shape));
    const double least = glm::dot(in_shape, vertices[highest]) - slack;
    const auto around = topology.neighborsOf(highest);
    const bool alone = std::none_of(around.begin(), around.end(),
                                    [&](std::uint32_t next) { return glm::dot(in_shape, vertices[next]) >= least; });
    return alone ? std::optional(worldFromShape(pose, vertices[highest])) : std::nullopt;
}

/// Whether the surface's plane holds a face of its solid, and that has the point (in the frame) over it.
bool isOverItsFace(const Surface& surface, const Vec3& point) {
    const auto face = faceOf(surface);
    return face && isOverFace(*surface.solid, *face, point);
}

} // namespace

Vec3 contactPoint(const Shape& shape, const Pose& pose, const Surface& surface, double t) {
    const Vec3 normal = surface.normalAt(t);
    const double slack = (surface.solid ? kSolidFlatness : kFlatness) * shape.length();
    const auto only = onlySupport(shape, pose, -normal, slack);
    if (only && (!surface.solid || isOverItsFace(surface, surface.frame.frameFromWorld(t, *only)))) {
        return *only;
    }
    if (surface.solid) {
        return contactWithSolid(shape, pose, surface, t);
    }
    const std::vector<Vec3> region = supportRegion(shape, pose, -normal, slack);
    const Plane plane(region.front(), normal);
    return plane.lifted(middleOf(plane.flattened(region)));
}

} // namespace elastoon
