// What a state that comes from outside must hold so that the simulation is safe with it. Null where it does; else what
// would be right.
#pragma once

#include "step.h"

namespace elastoon {

/// A world's clock at most, s: beyond it times are too coarse for contacts.
inline constexpr double kMostTime = 1e9;

[[nodiscard]] const char* flawOf(const Surface& surface);
[[nodiscard]] const char* flawOf(const Phase& phase, double now);
[[nodiscard]] const char* flawOf(const Event& event);
[[nodiscard]] const char* flawOf(const ObstacleSlot& slot, double now);

} // namespace elastoon
