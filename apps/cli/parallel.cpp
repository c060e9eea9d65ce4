// See parallel.h.
#include "parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <memory>

namespace elastoon {

namespace {

/// TBB starts no more threads than there are cores unless it is told to.
struct Crew {
    explicit Crew(int threads)
        : most(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)), arena(threads) {}
    tbb::global_control most;
    tbb::task_arena arena;
};

} // namespace

ParallelFor onThreads(int threads) {
    if (threads <= 1) {
        return {};
    }
    return [crew = std::make_shared<Crew>(threads)](std::size_t count,
                                                    const std::function<void(std::size_t, std::size_t)>& body) {
        constexpr std::size_t kGrain = 64;
        crew->arena.execute([&] {
            tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kGrain),
                              [&](const auto& range) { body(range.begin(), range.end()); });
        });
    };
}

} // namespace elastoon
