// See camera.h.
#include "camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace elastoon {

namespace {

constexpr double kFovDegrees = 24.0; // long lens: speeds are comparable across the picture
constexpr double kRise = 0.14;       // of the look down, over distance

void look(Camera& camera, const Vec3& forward, const Vec3& up) {
    camera.forward = forward;
    Vec3 right = glm::cross(forward, up);
    if (glm::length(right) < 1e-6) { // straight up or down: the top of the picture is then -z
        right = glm::cross(forward, std::fabs(forward.z) < 0.9 ? Vec3(0.0, 0.0, -1.0) : Vec3(1.0, 0.0, 0.0));
    }
    camera.right = glm::normalize(right);
    camera.up = glm::cross(camera.right, camera.forward);
}

/// Range of centre - slope * depth that keeps all points between both sides of the picture, for one of its directions.
struct Span {
    double low = std::numeric_limits<double>::infinity();   ///< least of coordinate + slope * depth
    double high = -std::numeric_limits<double>::infinity(); ///< greatest of coordinate - slope * depth

    void include(double coordinate, double depth, double slope) {
        low = std::min(low, coordinate + slope * depth);
        high = std::max(high, coordinate - slope * depth);
    }
    [[nodiscard]] double furthestDepth(double slope) const { return (low - high) / (2.0 * slope); }
    [[nodiscard]] double centre() const { return (low + high) / 2.0; }
};

} // namespace

Vec3 Camera::project(const Vec3& point) const {
    const Vec3 away = point - eye;
    const double depth = glm::dot(away, forward);
    return {glm::dot(away, right) / (depth * tan_half_height * aspect), glm::dot(away, up) / (depth * tan_half_height),
            depth};
}

Vec3 upOf(const Vec3& gravity) {
    const double size = glm::length(gravity);
    return size > 0.0 ? -gravity / size : Vec3(0.0, 1.0, 0.0);
}

Camera cameraFrom(const SceneCamera& scene_camera, const Vec3& up, double aspect) {
    Camera camera;
    camera.eye = scene_camera.eye;
    camera.aspect = aspect;
    camera.tan_half_height = std::tan(scene_camera.fov_degrees * std::numbers::pi / 360.0);
    const Vec3 sight = scene_camera.target - scene_camera.eye;
    look(camera, glm::length(sight) > 0.0 ? glm::normalize(sight) : Vec3(0.0, 0.0, -1.0), up);
    return camera;
}

Camera cameraAround(std::span<const Vec3> points, const Vec3& up, double aspect, double margin) {
    Camera camera;
    camera.aspect = aspect;
    camera.tan_half_height = std::tan(kFovDegrees * std::numbers::pi / 360.0);
    const Vec3 side = std::fabs(up.x) < 0.9 ? Vec3(1.0, 0.0, 0.0) : Vec3(0.0, 1.0, 0.0);
    const Vec3 level = glm::normalize(glm::cross(up, side - up * glm::dot(up, side)));
    look(camera, glm::normalize(level - up * kRise), up);
    if (points.empty()) {
        camera.eye = -8.0 * camera.forward;
        return camera;
    }
    const double room = 1.0 - 2.0 * margin;
    const double slope_x = camera.tan_half_height * aspect * room, slope_y = camera.tan_half_height * room;
    Span across, upright;
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3& point : points) {
        const double depth = glm::dot(point, camera.forward);
        across.include(glm::dot(point, camera.right), depth, slope_x);
        upright.include(glm::dot(point, camera.up), depth, slope_y);
        nearest = std::min(nearest, depth);
    }
    const double depth = std::min(across.furthestDepth(slope_x), upright.furthestDepth(slope_y));
    // A single point would put the eye on it.
    const double eye_depth = std::min(depth, nearest - 1e-9 * (1.0 + std::fabs(nearest)));
    camera.eye = camera.right * across.centre() + camera.up * upright.centre() + camera.forward * eye_depth;
    return camera;
}

} // namespace elastoon
