// The program's threads: oneTBB behind the library's interface.
#pragma once

#include "elastoon/world.h"

namespace elastoon {

/// Runs ranges on TBB's threads; empty for one. How many they are is up to tbb::global_control.
[[nodiscard]] ParallelFor onThreads(int threads);

} // namespace elastoon
