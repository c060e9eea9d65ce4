// Motion as keys for .glb files: translation, rotation and scale over time, in single precision.
#pragma once

#include "elastoon/timeline.h"

#include <array>
#include <vector>

namespace elastoon {

/// Keys of one node. Times rise strictly; neighbouring quaternions (x y z w, unit) lie on the same half sphere, so that
/// going straight from one to the next is the shortest way.
struct MotionKeys {
    std::vector<float> times; ///< s from the start
    std::vector<std::array<float, 3>> translations;
    std::vector<std::array<float, 4>> rotations;
    std::vector<std::array<float, 3>> scales;
};

/// The span of time that is written, and its frames.
struct MotionSpan {
    double start = 0.0, end = 0.0;
    std::vector<double> frames; ///< s from the start, the first 0
};

/// Times (s from the start) at which a body has a key: the frames, the end, and where its phases change or an impact is
/// deepest. Of times that are one in single precision, an event's is kept.
[[nodiscard]] std::vector<double> keyTimes(const Track& track, const MotionSpan& span);

/// A body's motion: exact at every key.
[[nodiscard]] MotionKeys motionOf(const Track& track, const MotionSpan& span);

/// The motion of an obstacle that was added at time 0: also exact at the keys of its path.
[[nodiscard]] MotionKeys motionOf(const ObstacleDef& obstacle, const MotionSpan& span);

} // namespace elastoon
