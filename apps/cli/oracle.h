// An independent witness of non-penetration: brute force over all vertices, in extended precision, from poses alone.
// It shares nothing with the collision code but the shapes' vertices.
#pragma once

#include "elastoon/scene.h"
#include "elastoon/timeline.h"

#include <string>

namespace elastoon {

/// The worst that was seen of one quantity.
struct Worst {
    double value = 0.0;
    double time = 0.0;
    std::string body, other;
};

/// Lengths are in units of the body's length L.
struct OracleReport {
    Worst depth;        ///< penetration into a plane
    Worst solid_depth;  ///< penetration into a solid
    Worst gap;          ///< distance from the nearest obstacle while in contact
    Worst volume_error; ///< |V / V0 - 1| of the deformed polytope
    Worst jump;         ///< step in position, or in stretch, or in orientation (rad), where one phase follows another
    std::size_t poses = 0;
    std::size_t not_finite = 0;

    static constexpr double kMostDepth = 1e-9, kMostSolidDepth = 1e-5, kMostGap = 1e-4, kMostVolumeError = 1e-9,
                            kMostJump = 1e-6;
    [[nodiscard]] bool withinBounds() const {
        return not_finite == 0 && depth.value <= kMostDepth && solid_depth.value <= kMostSolidDepth &&
               gap.value <= kMostGap && volume_error.value <= kMostVolumeError && jump.value <= kMostJump;
    }
};

/// Looks at every body at `fps` times a second, at every change of phase, and at 16 times within each impact.
[[nodiscard]] OracleReport inspect(const Scene& scene, const StagedScene& staged, const Timeline& timeline, double fps);

} // namespace elastoon
