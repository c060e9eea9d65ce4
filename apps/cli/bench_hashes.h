// The worlds of `elastoon bench`: how many bodies they usually have, and the state's hash after a second at 60 steps a
// second. scripts/make_golden.sh writes the hashes anew.
#pragma once

#include <cstddef>
#include <cstdint>

namespace elastoon {

struct BenchScene {
    const char* name;
    std::size_t bodies;
    std::uint64_t hash;
};

inline constexpr BenchScene kBenchScenes[] = {
    {"flight", 10000, 0x68447d81254bb965},  //
    {"rain", 10000, 0x0a4a3970e1bb0c4b},    //
    {"ballpit", 10000, 0xba732dbbd65d88be}, //
    {"pachinko", 1000, 0x5449bb3b2e022909}, //
    {"corners", 1000, 0xf5013a36e3e21972},
};

} // namespace elastoon
