// Seeded random numbers for benchmarks: the same on every machine.
#pragma once

#include "elastoon/math.h"

#include <cstdint>
#include <numbers>

namespace elastoon {

/// splitmix64.
class BenchRandom {
public:
    explicit BenchRandom(std::uint64_t seed) : state_(seed) {}

    double uniform(double low, double high) {
        return low + (high - low) * (static_cast<double>(next() >> 11) * 0x1p-53);
    }
    Vec3 direction() {
        for (;;) {
            const double x = uniform(-1, 1);
            const double y = uniform(-1, 1);
            const Vec3 v(x, y, uniform(-1, 1));
            const double length = glm::length(v);
            if (length > 0.1 && length < 1.0) {
                return v / length;
            }
        }
    }
    Quat rotation() {
        const Vec3 axis = direction();
        return glm::angleAxis(uniform(0.0, 2.0 * std::numbers::pi), axis);
    }

private:
    std::uint64_t next() {
        state_ += 0x9e3779b97f4a7c15ULL;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        return z ^ (z >> 31);
    }
    std::uint64_t state_;
};

} // namespace elastoon
