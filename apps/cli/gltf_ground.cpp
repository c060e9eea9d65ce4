// See gltf_ground.h.
#include "gltf_ground.h"

#include <array>

namespace elastoon {

namespace {

/// The part of a convex polygon in front of the plane (Sutherland and Hodgman 1974).
std::vector<Vec3> clipped(const std::vector<Vec3>& polygon, const WorldPlane& plane) {
    std::vector<Vec3> result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3& a = polygon[i];
        const Vec3& b = polygon[(i + 1) % polygon.size()];
        const double height_a = glm::dot(a - plane.point, plane.normal);
        const double height_b = glm::dot(b - plane.point, plane.normal);
        if (height_a >= 0.0) {
            result.push_back(a);
        }
        if ((height_a > 0.0 && height_b < 0.0) || (height_a < 0.0 && height_b > 0.0)) {
            result.push_back(a + (b - a) * (height_a / (height_a - height_b)));
        }
    }
    return result;
}

/// The world axis that lies most across the normal, laid into the plane.
Vec3 firstTangent(const Vec3& normal) {
    const Vec3 magnitude = glm::abs(normal);
    const Vec3 axis = magnitude.x <= magnitude.y && magnitude.x <= magnitude.z ? Vec3(1.0, 0.0, 0.0)
                      : magnitude.z <= magnitude.y                             ? Vec3(0.0, 0.0, 1.0)
                                                                               : Vec3(0.0, 1.0, 0.0);
    return glm::normalize(axis - normal * glm::dot(axis, normal));
}

} // namespace

void ActionBounds::add(const Vec3& center, double reach) {
    low = empty ? center - reach : glm::min(low, center - reach);
    high = empty ? center + reach : glm::max(high, center + reach);
    empty = false;
}

std::vector<Vec3> visiblePiece(const WorldPlane& plane, const ActionBounds& bounds,
                               const std::vector<WorldPlane>& others) {
    const Vec3 center = bounds.center() - plane.normal * glm::dot(bounds.center() - plane.point, plane.normal);
    const double half = 0.75 * bounds.size();
    const Vec3 u = firstTangent(plane.normal) * half;
    const Vec3 v = glm::cross(plane.normal, u);
    const std::vector<Vec3> square{center - u - v, center + u - v, center + u + v, center - u + v};
    std::vector<Vec3> piece = square;
    for (const WorldPlane& other : others) {
        piece = clipped(piece, other);
    }
    // A plane that is wholly hidden is shown whole: a file that leaves out what the scene names would puzzle.
    return piece.size() < 3 ? square : piece;
}

} // namespace elastoon
