// Distance of two posed solids by GJK with hill climbing and a warm simplex, and contact along a line. docs/vclip.md.
#pragma once

#include "closest.h"
#include "line_contact.h"

#include <optional>

namespace elastoon {

/// Uses and renews the seed's pairs; leaves its features.
[[nodiscard]] Closest gjkClosest(const PosedShape& a, const PosedShape& b, ClosestSeed& seed);

/// A better normal than `normal` for bodies that all but touch, where the difference of the nearest points has no
/// direction left: the best of those that the bodies have when they are drawn apart a little. Unit, from b towards a.
[[nodiscard]] Vec3 partingNormal(const PosedShape& a, const PosedShape& b, const Vec3& normal);

/// contactAlong by Newton's method on the distance: several times slower. The portal's fallback and its judge in tests.
[[nodiscard]] std::optional<LineContact> contactAlongByDistance(const PosedShape& a, const PosedShape& b,
                                                                const Vec3& direction);

} // namespace elastoon
