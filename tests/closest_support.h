// Seeded pairs of posed solids that break closest-point methods, and what is true of them by other means.
#pragma once

#include "closest.h"
#include "test_support.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

namespace elastoon {

/// How many times the normal number of cases: the environment variable ELASTOON_SOAK.
inline int soak() {
    const char* text = std::getenv("ELASTOON_SOAK");
    return text != nullptr ? std::max(1, std::atoi(text)) : 1;
}

inline PosedShape posed(const ShapePtr& shape, const Quat& rotation, double stretch, const Vec3& position) {
    return {shape.get(), linearOf({position, rotation, stretch}), position};
}

inline Vec3 worldOf(const PosedShape& body, const Vec3& point) {
    return body.position + body.linear * point;
}

/// Longest half axis of the posed body, about.
inline double sizeOf(const PosedShape& body) {
    double size = 0.0;
    for (const Vec3& vertex : body.shape->vertices()) {
        size = std::max(size, glm::length(body.linear * vertex));
    }
    return size;
}

inline double sizeOf(const PosedShape& a, const PosedShape& b) {
    return std::max(sizeOf(a), sizeOf(b));
}

/// Furthest along the direction, from the body's own position; over all vertices.
inline double reachOf(const PosedShape& body, const Vec3& direction) {
    double reach = -std::numeric_limits<double>::infinity();
    for (const Vec3& vertex : body.shape->vertices()) {
        reach = std::max(reach, glm::dot(direction, body.linear * vertex));
    }
    return reach;
}

/// Gap of the bodies between planes across the normal (unit, from b towards a).
inline double gapAcross(const PosedShape& a, const PosedShape& b, const Vec3& normal) {
    return glm::dot(normal, a.position - b.position) - reachOf(a, -normal) - reachOf(b, normal);
}

inline Vec3 faceNormal(const PosedShape& body, std::size_t face) {
    const auto loop = body.shape->face(face);
    const auto vertices = body.shape->vertices();
    Vec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
        sum += glm::cross(body.linear * (vertices[loop[i]] - vertices[loop[0]]),
                          body.linear * (vertices[loop[i + 1]] - vertices[loop[0]]));
    }
    return glm::normalize(sum);
}

/// How far the point is outside the body's furthest face plane; negative inside.
inline double outside(const PosedShape& body, const Vec3& point) {
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t face = 0; face < body.shape->faceCount(); ++face) {
        const Vec3 corner = body.linear * body.shape->vertices()[body.shape->face(face)[0]];
        most = std::max(most, glm::dot(faceNormal(body, face), (point - body.position) - corner));
    }
    return most;
}

/// Whether the answer proves itself: the points are of the bodies and as far apart as two parallel planes between the
/// bodies are; or the witness is in both. What is wrong, or empty.
inline std::string flawOf(const Closest& closest, const PosedShape& a, const PosedShape& b, double tolerance) {
    if (closest.overlap) {
        const double out = std::max(outside(a, closest.witness), outside(b, closest.witness));
        return out <= tolerance ? "" : "witness is outside by " + std::to_string(out);
    }
    if (std::fabs(glm::length(closest.normal) - 1.0) > 1e-12) {
        return "normal is not unit";
    }
    const double off = std::max(outside(a, closest.point_a), outside(b, closest.point_b));
    if (off > tolerance) {
        return "a point is off its body by " + std::to_string(off);
    }
    const double between = glm::length(closest.point_a - closest.point_b);
    if (std::fabs(between - closest.distance) > tolerance) {
        return "the points are not at the distance";
    }
    const double short_by = closest.distance - gapAcross(a, b, closest.normal);
    return std::fabs(short_by) <= tolerance ? "" : "no planes prove the distance: short by " + std::to_string(short_by);
}

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

/// One of the 24 rotations of the cube, as a matrix of exact numbers.
inline Mat3 latticeRotation(int index) {
    constexpr std::array<std::array<int, 3>, 6> kOrders{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    const auto& order = kOrders[static_cast<std::size_t>(index / 4)];
    Mat3 turned(0.0);
    turned[order[0]][0] = index % 2 == 0 ? 1.0 : -1.0;
    turned[order[1]][1] = index / 2 % 2 == 0 ? 1.0 : -1.0;
    turned[order[2]][2] = 1.0;
    turned[order[2]][2] = glm::determinant(turned);
    return turned;
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
