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
    {"flight", 10000, 0x165f17ab85a9c5f4},  //
    {"rain", 10000, 0x5cf8675fa8c85235},    //
    {"ballpit", 10000, 0x09734c0bd3a97657}, //
    {"pachinko", 1000, 0x4feae03be03e867a}, //
    {"corners", 1000, 0x54a961974c23db8e},
};

} // namespace elastoon
