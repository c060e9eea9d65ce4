// The distance of two posed solids in extended precision, with a proof of how good it is.
#pragma once

#include "elastoon/shape.h"

namespace elastoon {

struct ReferenceDistance {
    double distance = 0.0;
    /// The true distance is less than this below it: two parallel planes, against all vertices, say so.
    double slack = 0.0;
};

/// The solids must be apart.
[[nodiscard]] ReferenceDistance referenceDistance(const Shape& a, const Pose& pose_a, const Shape& b,
                                                  const Pose& pose_b);

} // namespace elastoon
