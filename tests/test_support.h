// What tests share: seeded random numbers that are the same everywhere, and short ways to make worlds.
#pragma once

#include "../apps/seeded_random.h"
#include "elastoon/timeline.h"
#include "elastoon/world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace elastoon {

/// How many times the normal number of random cases: the environment variable ELASTOON_SOAK.
inline int soak() {
    const char* text = std::getenv("ELASTOON_SOAK");
    return text != nullptr ? std::max(1, std::atoi(text)) : 1;
}

class Random : public SeededRandom {
public:
    using SeededRandom::SeededRandom;

    int below(int count) { return static_cast<int>(next() % static_cast<std::uint64_t>(count)); }
    Vec3 inBox(double half) { return {uniform(-half, half), uniform(-half, half), uniform(-half, half)}; }
    Vec3 direction() {
        for (;;) {
            const Vec3 v = inBox(1.0);
            const double length = glm::length(v);
            if (length > 0.1 && length < 1.0) {
                return v / length;
            }
        }
    }
    Quat rotation() {
        for (;;) {
            const Quat q(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
            const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
            if (length > 0.1 && length < 1.0) {
                return Quat(q.w / length, q.x / length, q.y / length, q.z / length);
            }
        }
    }
};

/// Lively and dull, by either law, queued in corners.
inline Style anyStyle(Random& random) {
    Style style;
    style.restitution = random.uniform(0.0, 1.0);
    style.max_stretch = random.uniform(1.1, 2.5);
    style.min_squash = random.uniform(0.3, 0.9);
    style.stretch_rate = random.uniform(0.05, 0.5);
    style.squash_rate = random.uniform(0.5, 2.0);
    style.squash_law = random.below(2) == 0 ? SquashLaw::Paper : SquashLaw::Bounded;
    style.friction = random.uniform(0.0, 1.0);
    return style;
}

/// The value, or a failed test.
template <class T>
T valueOf(Result<T> result) {
    if (!result) {
        ADD_FAILURE() << result.error().text();
        std::abort();
    }
    return std::move(result).value();
}

inline World worldWith(const Vec3& gravity = {0.0, -9.81, 0.0}) {
    return valueOf(World::create({.gravity = gravity, .parallel_for = {}}));
}

inline World worldWithFloor(const Vec3& gravity = {0.0, -9.81, 0.0}) {
    World world = worldWith(gravity);
    valueOf(world.addObstacle(ObstacleDef::plane({0.0, 1.0, 0.0}, 0.0)));
    return world;
}

/// Angle between two orientations, rad.
inline double angleBetween(const Quat& a, const Quat& b) {
    const Quat turn = glm::conjugate(a) * b;
    return 2.0 * std::asin(std::min(1.0, std::sqrt(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z)));
}

/// Angle between two axes, whichever end leads, rad.
inline double angleBetweenAxes(const Vec3& a, const Vec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), std::fabs(glm::dot(a, b)));
}

/// Height of the lowest point above y = 0, by brute force.
inline double lowestPoint(const Shape& shape, const Pose& pose) {
    double lowest = 1e300;
    for (const Vec3& vertex : shape.vertices()) {
        lowest = std::min(lowest, worldFromShape(pose, vertex).y);
    }
    return lowest;
}

} // namespace elastoon
