// elastoon_golden HASHES SCENES [THREADS]: runs the scenes of a file of golden hashes and prints scene, steps a second
// and hash. On more threads than one the matrices are written too. Exit codes: 0 all are met, 1 some differ, 2 bad use
// or something could not be read.
#include "golden_run.h"

#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

namespace {

/// A thread for each part of the bodies, of which there are as many as threads.
elastoon::ParallelFor onThreads(long threads) {
    return [threads](std::size_t count, const std::function<void(std::size_t, std::size_t)>& body) {
        const auto parts = static_cast<std::size_t>(threads);
        std::vector<std::thread> crew;
        for (std::size_t i = 0; i < parts; ++i) {
            crew.emplace_back([&, i] { body(count * i / parts, count * (i + 1) / parts); });
        }
        for (std::thread& worker : crew) {
            worker.join();
        }
    };
}

} // namespace

int main(int argc, char** argv) {
    using namespace elastoon;
    const long threads = argc == 4 ? std::strtol(argv[3], nullptr, 10) : 1;
    if ((argc != 3 && argc != 4) || threads < 1 || threads > 64) {
        std::fprintf(stderr, "usage: elastoon_golden HASHES SCENES [THREADS, 1 to 64]\n");
        return 2;
    }
    const auto draw = [](const Scene&, StagedScene& staged) { (void)staged.world.matrices(); };
    const auto goldens = readGoldens(argv[1]);
    if (!goldens) {
        std::fprintf(stderr, "elastoon_golden: %s\n", goldens.error().text().c_str());
        return 2;
    }
    std::size_t met = 0;
    for (const Golden& golden : goldens.value()) {
        const auto ended =
            threads > 1 ? runGolden(golden, argv[2], draw, onThreads(threads)) : runGolden(golden, argv[2]);
        if (!ended) {
            std::fprintf(stderr, "elastoon_golden: %s\n", ended.error().text().c_str());
            return 2;
        }
        const std::uint64_t hash = ended.value().world.stateHash();
        std::printf("%s %g %016" PRIx64, golden.scene.c_str(), golden.fps, hash);
        if (hash == golden.hash) {
            std::printf("\n");
            ++met;
        } else {
            std::printf(" DIFFERS from %016" PRIx64 "\n", golden.hash);
        }
    }
    std::printf("%zu of %zu golden hashes are met\n", met, goldens.value().size());
    return met == goldens.value().size() && met > 0 ? 0 : 1;
}
