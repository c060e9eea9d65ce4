// Rotations between directions, without trigonometry where it can be avoided, and well-conditioned to the half turn.
#pragma once

#include "dmath.h"
#include "elastoon/math.h"

namespace elastoon {

/// Some unit vector across `direction` (unit): the same one on every machine.
[[nodiscard]] inline Vec3 anyAcross(const Vec3& direction) {
    const Vec3 magnitude = glm::abs(direction);
    const Vec3 least = magnitude.x <= magnitude.y && magnitude.x <= magnitude.z ? Vec3(1.0, 0.0, 0.0)
                       : magnitude.y <= magnitude.z                             ? Vec3(0.0, 1.0, 0.0)
                                                                                : Vec3(0.0, 0.0, 1.0);
    return glm::normalize(least - direction * glm::dot(least, direction));
}

/// Turns that take one unit vector to another: the axis (unit) and the angle in 0..pi.
struct Turn {
    Vec3 axis{0.0, 0.0, 1.0};
    double angle = 0.0;
};

/// A turn by what half of it needs.
struct HalfTurn {
    Vec3 axis;
    double sine, cosine;
};

/// The smallest turn from `from` to `to` (unit). Of the half turns it takes the one through `via` (unit, or zero: any).
[[nodiscard]] inline HalfTurn halfTurnBetween(const Vec3& from, const Vec3& to, const Vec3& via = Vec3(0.0)) {
    const double cosine = 0.5 * glm::length(from + to);
    const double sine = 0.5 * glm::length(from - to);
    const Vec3 cross = glm::cross(from, to);
    const double length = glm::length(cross);
    if (length > 1e-9) {
        return {cross / length, sine, cosine};
    }
    const Vec3 through = glm::cross(from, via);
    const double weight = glm::length(through);
    const Vec3 fallback = weight > 1e-9 ? through / weight : anyAcross(from);
    return {length > 0.0 && cosine >= 0.5 ? cross / length : fallback, sine, cosine};
}

/// Likewise.
[[nodiscard]] inline Turn turnBetween(const Vec3& from, const Vec3& to, const Vec3& via = Vec3(0.0)) {
    const HalfTurn half = halfTurnBetween(from, to, via);
    return {half.axis, 2.0 * detAtan2(half.sine, half.cosine)};
}

[[nodiscard]] inline Quat rotationAbout(const Vec3& axis, double angle) {
    const SinCos half = detSinCos(0.5 * angle);
    return {half.cos, axis.x * half.sin, axis.y * half.sin, axis.z * half.sin};
}

/// Likewise.
[[nodiscard]] inline Quat rotationBetween(const Vec3& from, const Vec3& to) {
    const HalfTurn half = halfTurnBetween(from, to);
    return {half.cosine, half.axis.x * half.sine, half.axis.y * half.sine, half.axis.z * half.sine};
}

[[nodiscard]] inline Vec3 principalAxis(const Quat& orientation) {
    return orientation * Vec3(1.0, 0.0, 0.0);
}

[[nodiscard]] inline Quat unitOf(const Quat& q) {
    const double scale = 1.0 / std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return {q.w * scale, q.x * scale, q.y * scale, q.z * scale};
}

} // namespace elastoon
