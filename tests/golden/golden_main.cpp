// elastoon_golden HASHES SCENES: runs the scenes of a file of golden hashes and prints scene, steps a second and hash.
// Exit codes: 0 all are met, 1 some differ, 2 something could not be read.
#include "golden_run.h"

#include <cinttypes>
#include <cstdio>

int main(int argc, char** argv) {
    using namespace elastoon;
    if (argc != 3) {
        std::fprintf(stderr, "usage: elastoon_golden HASHES SCENES\n");
        return 2;
    }
    const auto goldens = readGoldens(argv[1]);
    if (!goldens) {
        std::fprintf(stderr, "elastoon_golden: %s\n", goldens.error().text().c_str());
        return 2;
    }
    std::size_t met = 0;
    for (const Golden& golden : goldens.value()) {
        const auto ended = runGolden(golden, argv[2]);
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
