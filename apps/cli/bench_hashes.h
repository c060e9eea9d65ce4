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
    {"rain", 10000, 0x72ad107a906b8d8d},    //
    {"ballpit", 10000, 0xcc4f00309e77e1bd}, //
    {"pachinko", 1000, 0xb9f4a2c458ea5901}, //
    {"corners", 1000, 0xbc4bce9efe82d3cf},
};

} // namespace elastoon
