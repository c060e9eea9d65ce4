// Closest features of two posed solids by V-Clip: no tolerance, no iteration towards a limit. docs/vclip.md.
#pragma once

#include "closest.h"

namespace elastoon {

/// What happened on the way: for tests and measurements.
struct VclipCounts {
    int steps = 0;    ///< pairs of features looked at
    int escapes = 0;  ///< local minima left by looking at every face
    int cycles = 0;   ///< walks that came back to a pair, handed to GJK
    int unproven = 0; ///< ends that parallel planes did not prove, handed to GJK
    int open = 0;     ///< bodies whose surface is not closed, handed to GJK
};

/// Uses and renews the seed's features, and its pairs where GJK has to take over.
[[nodiscard]] Closest vclipClosest(const PosedShape& a, const PosedShape& b, ClosestSeed& seed,
                                   VclipCounts* counts = nullptr);

} // namespace elastoon
