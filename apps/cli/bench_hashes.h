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
    {"rain", 10000, 0x6afa25b27d202a3a},    //
    {"ballpit", 10000, 0xba732dbbd65d88be}, //
    {"pachinko", 1000, 0xeda4a829da17cfb4}, //
    {"corners", 1000, 0x4872de33f5eb231a},
};

} // namespace elastoon
