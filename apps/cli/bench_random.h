// Seeded random numbers for benchmarks: the same on every machine.
#pragma once

#include "../seeded_random.h"
#include "elastoon/math.h"

#include <numbers>

namespace elastoon {

class BenchRandom : public SeededRandom {
public:
    using SeededRandom::SeededRandom;

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
};

} // namespace elastoon
