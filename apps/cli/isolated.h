// Work by a library that may crash, hang or take all memory on bad input, done in a process of its own.
#pragma once

#include "elastoon/result.h"

#include <cstddef>
#include <functional>
#include <string>

namespace elastoon {

struct IsolationLimits {
    int seconds = 5; ///< of processor time
    std::size_t memory = std::size_t{1} << 30; ///< bytes of address space; sanitized builds have no limit
};

/// What `work` returned in a copy of this process. Error (without a place): it crashed, took too long, or was stopped
/// by Ctrl-C. Call it while no other thread runs.
[[nodiscard]] Result<std::string> runIsolated(const std::function<std::string()>& work, const IsolationLimits& limits);

} // namespace elastoon
