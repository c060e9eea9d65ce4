// Obstacles on paths: between two keys a frame with constant velocities. See PathKey in world.h.
#pragma once

#include "elastoon/world.h"

namespace elastoon {

/// What of an obstacle's definition moves it.
struct Path {
    double added = 0.0;
    Vec3 position{0.0}; ///< where it was added
    Quat rotation{kNoRotation};
    std::vector<PathKey> keys;
    bool repeats = false;
};

/// The frame that moves from one pose at time `from` to another at time `to`.
[[nodiscard]] MovingFrame frameBetween(double from, const Vec3& position, const Quat& rotation, double to,
                                       const Vec3& next_position, const Quat& next_rotation);
/// The frame of the leg that holds from time t on.
[[nodiscard]] MovingFrame frameAt(const Path& path, double t);
/// First time after t at which the frame changes; infinite when it never does.
[[nodiscard]] double nextChange(const Path& path, double t);

} // namespace elastoon
