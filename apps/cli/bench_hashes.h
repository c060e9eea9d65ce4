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
    {"flight", 10000, 0x45196b761d3b1ca1},  //
    {"rain", 10000, 0xc6c37b7cfad88e7c},    //
    {"ballpit", 10000, 0x09734c0bd3a97657}, //
    {"pachinko", 1000, 0xe675d6fd874d28e5}, //
    {"corners", 1000, 0x7f8cb7f6f5462641},
};

} // namespace elastoon
