// Where pictures are seen from: the scene's camera, or one that frames the whole action.
#pragma once

#include "elastoon/math.h"
#include "elastoon/scene.h"

#include <span>

namespace elastoon {

/// A pinhole camera. The three directions are unit and at right angles.
struct Camera {
    Vec3 eye{0.0, 0.0, 5.0};
    Vec3 right{1.0, 0.0, 0.0}, up{0.0, 1.0, 0.0}, forward{0.0, 0.0, -1.0};
    double tan_half_height = 0.3; ///< half the picture's height at distance 1
    double aspect = 16.0 / 9.0;   ///< width / height

    /// Where a point appears: x and y in -1..1 inside the picture, y up; z its depth.
    [[nodiscard]] Vec3 project(const Vec3& point) const;
};

/// Against gravity; +y where there is none.
[[nodiscard]] Vec3 upOf(const Vec3& gravity);

/// The camera that a scene names.
[[nodiscard]] Camera cameraFrom(const SceneCamera& camera, const Vec3& up, double aspect);

/// A camera from in front and slightly above that holds all the points, with `margin` (a share of the picture's width
/// and height) left free on every side.
[[nodiscard]] Camera cameraAround(std::span<const Vec3> points, const Vec3& up, double aspect, double margin = 0.08);

} // namespace elastoon
