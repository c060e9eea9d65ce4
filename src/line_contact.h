// Where a posed convex solid that moves along a line touches another. docs/vclip.md.
#pragma once

#include "closest.h"

#include <cstdint>
#include <optional>

namespace elastoon {

/// The bodies when a has been moved by `shift` along the line: they touch there.
struct LineContact {
    double shift = 0.0;
    /// Unit, from b towards a: of a plane that parts the bodies there. Where several do, one of them.
    Vec3 normal{0.0};
};

/// The greatest shift t for which a, moved by t * direction (unit), still touches b; negative where they are apart and
/// a must come nearer. None if the line of motion never meets b. It has no memory; error about 1e-14 of the size over
/// the sine of the angle between the line and the surface.
[[nodiscard]] std::optional<LineContact> contactAlong(const PosedShape& a, const PosedShape& b, const Vec3& direction);

/// The shift alone.
[[nodiscard]] std::optional<double> separationAlong(const PosedShape& a, const PosedShape& b, const Vec3& direction);

/// Unsure: rounding decides, or the search went on too long.
enum class PortalEnd : std::uint8_t { Touches, Misses, Unsure };

/// The first of the two methods of contactAlong, alone: sets the contact where it is sure that they touch.
[[nodiscard]] PortalEnd contactByPortal(const PosedShape& a, const PosedShape& b, const Vec3& direction,
                                        LineContact& contact);

} // namespace elastoon
