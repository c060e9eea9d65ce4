// Distance of two posed solids by GJK with hill climbing and a warm simplex, and contact along a line. docs/vclip.md.
#pragma once

#include "closest.h"

#include <optional>

namespace elastoon {

/// Uses and renews the seed's pairs; leaves its features.
[[nodiscard]] Closest gjkClosest(const PosedShape& a, const PosedShape& b, ClosestSeed& seed);

/// A better normal than `normal` for bodies that all but touch, where the difference of the nearest points has no
/// direction left: the best of those that the bodies have when they are drawn apart a little. Unit, from b towards a.
[[nodiscard]] Vec3 partingNormal(const PosedShape& a, const PosedShape& b, const Vec3& normal);

/// The bodies when a has been moved by `shift` along the line: they touch there.
struct LineContact {
    double shift = 0.0;
    Vec3 point{0.0};  ///< where they touch, with a moved
    Vec3 normal{0.0}; ///< unit, from b towards a
    Feature feature_a, feature_b;
};

/// The greatest shift t for which a, moved by t * direction (unit), still touches b; negative where they are apart and
/// a must come nearer. None if the line of motion never meets b. It has no memory; error about 1e-14 of the size over
/// the sine of the angle between the line and the surface.
[[nodiscard]] std::optional<LineContact> contactAlong(const PosedShape& a, const PosedShape& b, const Vec3& direction);

/// The shift alone.
[[nodiscard]] std::optional<double> separationAlong(const PosedShape& a, const PosedShape& b, const Vec3& direction);

} // namespace elastoon
