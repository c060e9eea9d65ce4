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
    {"flight", 10000, 0x85d7358e0f692fe2},  //
    {"rain", 10000, 0xb0ff196a44537c22},    //
    {"ballpit", 10000, 0x09734c0bd3a97657}, //
    {"pachinko", 1000, 0x8944355673c65044}, //
    {"corners", 1000, 0x12037804b4a95c4c},
};

} // namespace elastoon
