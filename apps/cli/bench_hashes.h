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
    {"flight", 10000, 0x294dfcefd2e71cd5},  //
    {"rain", 10000, 0x48ed15b8a8cd458a},    //
    {"ballpit", 10000, 0x388f3d936d7d4c1c}, //
    {"pachinko", 1000, 0x8e39d8e44d3d118c}, //
    {"corners", 1000, 0x3f148b536fdb2005},
};

} // namespace elastoon
