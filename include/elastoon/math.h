// The linear algebra that the interface speaks: glm's double types, and the pose of a stretched body.
#pragma once

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <cmath>

namespace elastoon {

using Vec3 = glm::dvec3;
using Quat = glm::dquat;
using Mat3 = glm::dmat3;

/// No rotation. (glm's constructor takes w first; files and tables of this project hold x y z w.)
inline constexpr Quat kNoRotation{1.0, 0.0, 0.0, 0.0};

/// Where a body is and how it is stretched: x = position + R diag(s, 1/sqrt(s), 1/sqrt(s)) X for a point X of its
/// shape. Paper, section 3.1, equation 1.
struct Pose {
    Vec3 position{0.0};            ///< of the shape's volume centroid, m
    Quat orientation{kNoRotation}; ///< unit; its x axis is the principal axis
    double stretch = 1.0;          ///< s, scale along the principal axis; > 0; the volume is kept
};

/// The diagonal of the deformation: s, 1/sqrt(s), 1/sqrt(s).
[[nodiscard]] inline Vec3 scaleOf(double stretch) {
    const double across = 1.0 / std::sqrt(stretch);
    return {stretch, across, across};
}

/// The linear part of the pose, R S. Columns are the images of the shape's axes. Its determinant is 1.
[[nodiscard]] inline Mat3 linearOf(const Pose& pose) {
    const Mat3 rotation = glm::mat3_cast(pose.orientation);
    const Vec3 scale = scaleOf(pose.stretch);
    return {rotation[0] * scale.x, rotation[1] * scale.y, rotation[2] * scale.z};
}

/// World position of the point `point_in_shape` of the shape.
[[nodiscard]] inline Vec3 worldFromShape(const Pose& pose, const Vec3& point_in_shape) {
    return pose.position + pose.orientation * (scaleOf(pose.stretch) * point_in_shape);
}

} // namespace elastoon
