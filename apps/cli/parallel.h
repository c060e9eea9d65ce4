// Threads of the program and of the benchmark: oneTBB behind the library's interface.
#pragma once

#include "elastoon/world.h"

namespace elastoon {

/// Runs ranges on so many of TBB's threads, which live as long as what is returned; empty for one.
[[nodiscard]] ParallelFor onThreads(int threads);

} // namespace elastoon
