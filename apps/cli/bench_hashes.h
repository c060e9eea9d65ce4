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
    {"flight", 10000, 0x385f7f6f0e699fed},  //
    {"rain", 10000, 0xaf2b1b9e1f9c4915},    //
    {"ballpit", 10000, 0x09734c0bd3a97657}, //
    {"pachinko", 1000, 0xa6be79897a8bfe71}, //
    {"corners", 1000, 0x113f83e0ba291eed},
};

} // namespace elastoon
