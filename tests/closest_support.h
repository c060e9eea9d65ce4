// Seeded pairs of posed solids that break closest-point methods, and what is true of them by other means.
#pragma once

#include "closest_judge.h"
#include "test_support.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

namespace elastoon {

struct Solids {
    std::vector<ShapePtr> small;
    std::vector<ShapePtr> all;
};

inline const Solids& solids() {
    static const Solids kSolids = [] {
        Solids made;
        const std::vector<Vec3> tetrahedron{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
        std::vector<Vec3> prism;
        for (const double x : {-0.75, 0.75}) {
            prism.insert(prism.end(), {{x, 0, 0}, {x, 1, 0}, {x, 0, 1}});
        }
        made.small = {valueOf(Shape::box({1, 1, 1})), valueOf(Shape::hull(tetrahedron)), valueOf(Shape::hull(prism))};
        made.all = made.small;
        made.all.push_back(valueOf(Shape::box({2, 1, 0.25})));
        made.all.push_back(valueOf(Shape::cylinder(0.5, 1.5, 16)));
        made.all.push_back(valueOf(Shape::cone(0.5, 1.0, 12)));
        made.all.push_back(valueOf(Shape::capsule(0.25, 1.0, 8)));
        made.all.push_back(valueOf(Shape::sphere(0.5, 4)));
        made.all.push_back(valueOf(Shape::sphere(0.5, 8)));
        Random random(7);
        std::vector<Vec3> cloud;
        for (int i = 0; i < 40; ++i) {
            cloud.push_back(random.inBox(0.5));
        }
        made.all.push_back(valueOf(Shape::hull(cloud)));
        return made;
    }();
    return kSolids;
}

inline ShapePtr anyOf(Random& random, const std::vector<ShapePtr>& shapes) {
    return shapes[static_cast<std::size_t>(random.below(static_cast<int>(shapes.size())))];
}

/// A stretch of 1/4 to 4, evenly by its logarithm; now and then 0.05 or 5.
inline double anyStretch(Random& random) {
    const int extreme = random.below(10);
    return extreme == 0 ? 0.05 : extreme == 1 ? 5.0 : std::pow(4.0, random.uniform(-1, 1));
}

/// A body moved so that along some direction it is `low` to `high` of the way out of the other.
inline Vec3 besides(Random& random, const PosedShape& a, const PosedShape& b, double low, double high) {
    const Vec3 direction = random.direction();
    return b.position + direction * ((reachOf(a, -direction) + reachOf(b, direction)) * random.uniform(low, high));
}

struct Bodies {
    PosedShape a, b;
};

inline Bodies randomPair(Random& random, const std::vector<ShapePtr>& shapes) {
    Bodies pair{posed(anyOf(random, shapes), random.rotation(), anyStretch(random), Vec3(0.0)),
                posed(anyOf(random, shapes), random.rotation(), anyStretch(random), random.inBox(5.0))};
    pair.a.position = besides(random, pair.a, pair.b, 0.2, 1.2);
    return pair;
}

/// Faces and edges exactly parallel: rotations of the cube, positions in quarters, stretches 1/4, 1 and 4.
inline Bodies latticePair(Random& random, const std::vector<ShapePtr>& shapes) {
    constexpr std::array<double, 3> kStretches{0.25, 1.0, 4.0};
    const auto place = [&](int reach) {
        const ShapePtr shape = anyOf(random, shapes);
        const Vec3 scale = scaleOf(kStretches[static_cast<std::size_t>(random.below(3))]);
        Mat3 linear = latticeRotation(random.below(24));
        for (int i = 0; i < 3; ++i) {
            linear[i] *= scale[i];
        }
        const auto quarter = [&] { return 0.25 * (random.below(2 * reach + 1) - reach); };
        const double x = quarter();
        const double y = quarter();
        return PosedShape{shape.get(), linear, {x, y, quarter()}};
    };
    return {place(6), place(0)};
}

/// Parallel but for a turn of 1e-16 to 1e-2: slopes and planes at the edge of rounding.
inline Bodies nearlyParallelPair(Random& random, const std::vector<ShapePtr>& shapes) {
    Bodies pair = latticePair(random, shapes);
    const double angle = std::pow(10.0, random.uniform(-16, -2));
    pair.a.linear = glm::mat3_cast(glm::angleAxis(angle, random.direction())) * pair.a.linear;
    return pair;
}

/// Both turned together: parallel to within rounding, in no special direction.
inline Bodies turnedLatticePair(Random& random, const std::vector<ShapePtr>& shapes) {
    Bodies pair = latticePair(random, shapes);
    const Mat3 turn = glm::mat3_cast(random.rotation());
    const Vec3 shift = random.inBox(10.0);
    for (PosedShape* body : {&pair.a, &pair.b}) {
        body->linear = turn * body->linear;
        body->position = turn * body->position + shift;
    }
    return pair;
}

/// One body inside the other or across its skin, sizes to a million times different.
inline Bodies unequalPair(Random& random, const std::vector<ShapePtr>& shapes) {
    Bodies pair = randomPair(random, shapes);
    const double ratio = std::pow(10.0, random.uniform(-6, 0));
    (random.below(2) == 0 ? pair.a : pair.b).linear *= ratio;
    pair.a.position = besides(random, pair.a, pair.b, random.below(2) == 0 ? 0.0 : 0.9, 1.1);
    return pair;
}

/// A body that flies past or through another, turning and stretching, for times 0..1.
struct Motion {
    ShapePtr shape;
    PosedShape b;
    Quat rotation{kNoRotation};
    Vec3 axis{0.0}, from{0.0}, to{0.0};
    double turn = 0.0, stretch_from = 1.0, stretch_to = 1.0;

    [[nodiscard]] Bodies at(double time) const {
        const Quat turned = glm::angleAxis(turn * time, axis) * rotation;
        const double stretch = stretch_from + (stretch_to - stretch_from) * time;
        return {posed(shape, turned, stretch, from + time * (to - from)), b};
    }
};

inline Motion anyMotion(Random& random, const std::vector<ShapePtr>& shapes) {
    Motion motion;
    motion.shape = anyOf(random, shapes);
    motion.b = posed(anyOf(random, shapes), random.rotation(), 1.0, random.inBox(2.0));
    motion.rotation = random.rotation();
    motion.axis = random.direction();
    motion.turn = random.uniform(0.0, 2.0);
    motion.stretch_from = std::pow(2.0, random.uniform(-1, 1));
    motion.stretch_to = std::pow(2.0, random.uniform(-1, 1));
    motion.from = besides(random, motion.at(0.0).a, motion.b, 0.7, 1.2);
    motion.to = motion.from + random.inBox(0.6 * sizeOf(motion.b));
    return motion;
}

} // namespace elastoon
