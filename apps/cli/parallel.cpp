// See parallel.h.
#include "parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace elastoon {

ParallelFor onThreads(int threads) {
    if (threads == 1) {
        return {};
    }
    return [](std::size_t count, const std::function<void(std::size_t, std::size_t)>& body) {
        constexpr std::size_t kGrain = 64;
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kGrain),
                          [&](const auto& range) { body(range.begin(), range.end()); });
    };
}

} // namespace elastoon
