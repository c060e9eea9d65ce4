// The drawn surfaces: closed, outward, on the true surface, and painted so that motion can be read.
#include "drawn_mesh.h"

#include "test_support.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

namespace elastoon {
namespace {

constexpr double kPi = std::numbers::pi;

struct Case {
    std::string name;
    ShapePtr shape;
    double true_volume;
    double (*distance)(const Shape&, const Vec3&); ///< of a point from the true surface; null for polytopes
};

double fromSphere(const Shape& shape, const Vec3& p) {
    return glm::length(p) - shape.radius();
}

/// Distance from the outline of a body of revolution, in the half plane (x, r).
double fromCylinder(const Shape& shape, const Vec3& p) {
    const double r = std::hypot(p.y, p.z) - shape.radius();
    return std::max(r, std::fabs(p.x) - shape.length() / 2.0);
}

double fromCone(const Shape& shape, const Vec3& p) {
    const double slant = std::hypot(shape.radius(), shape.length());
    const double side =
        ((p.x - 0.75 * shape.length()) * shape.radius() + std::hypot(p.y, p.z) * shape.length()) / slant;
    return std::max(side, -shape.length() / 4.0 - p.x);
}

double fromCapsule(const Shape& shape, const Vec3& p) {
    const double half = shape.length() / 2.0 - shape.radius();
    const Vec3 nearest(std::clamp(p.x, -half, half), 0.0, 0.0);
    return glm::length(p - nearest) - shape.radius();
}

std::vector<Case> cases() {
    const std::vector<Vec3> points{{0.6, 0, 0}, {-0.6, 0, 0}, {0, 0.5, 0}, {0, -0.5, 0}, {0, 0, 0.5}, {0, 0, -0.5}};
    const double caps = 4.0 / 3.0 * kPi * 0.027;
    return {
        {"sphere", valueOf(Shape::sphere(0.7)), 4.0 / 3.0 * kPi * 0.343, &fromSphere},
        {"box", valueOf(Shape::box({1.0, 0.6, 2.0})), 1.2, nullptr},
        {"cylinder", valueOf(Shape::cylinder(0.4, 1.5)), kPi * 0.16 * 1.5, &fromCylinder},
        {"cone", valueOf(Shape::cone(0.5, 1.2)), kPi * 0.25 * 0.4, &fromCone},
        {"capsule", valueOf(Shape::capsule(0.3, 1.4)), caps + kPi * 0.09 * 0.8, &fromCapsule},
        {"ball capsule", valueOf(Shape::capsule(0.3, 0.6)), caps, &fromCapsule},
        {"hull", valueOf(Shape::hull(points)), 0.2, nullptr},
    };
}

Vec3 wide(const std::array<float, 3>& v) {
    return {v[0], v[1], v[2]};
}

double volumeOf(const DrawnMesh& mesh) {
    double volume = 0.0;
    for (const auto& t : mesh.triangles) {
        const Vec3 a = wide(mesh.positions[t[0]]), b = wide(mesh.positions[t[1]]), c = wide(mesh.positions[t[2]]);
        volume += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    return volume;
}

TEST(DrawnMesh, EveryEdgeIsSharedByTwoTrianglesInOppositeDirections) {
    for (const Case& each : cases()) {
        const DrawnMesh mesh = drawnMesh(*each.shape, true);
        std::map<std::pair<std::array<float, 3>, std::array<float, 3>>, int> edges;
        for (const auto& triangle : mesh.triangles) {
            for (std::size_t i = 0; i < 3; ++i) {
                ++edges[{mesh.positions[triangle[i]], mesh.positions[triangle[(i + 1) % 3]]}];
            }
        }
        for (const auto& [edge, count] : edges) {
            ASSERT_EQ(count, 1) << each.name;
            ASSERT_NE(edge.first, edge.second) << each.name;
            const auto back = edges.find({edge.second, edge.first});
            ASSERT_TRUE(back != edges.end() && back->second == 1)
                << each.name << " is open at " << edge.first[0] << ' ' << edge.first[1] << ' ' << edge.first[2];
        }
    }
}

TEST(DrawnMesh, VolumeIsNearTheTrueOne) {
    for (const Case& each : cases()) {
        const double volume = volumeOf(drawnMesh(*each.shape, true));
        EXPECT_NEAR(volume, each.true_volume, 0.004 * each.true_volume) << each.name;
    }
}

TEST(DrawnMesh, NormalsAreUnitAndOnTheTrianglesOuterSide) {
    for (const Case& each : cases()) {
        const DrawnMesh mesh = drawnMesh(*each.shape, true);
        ASSERT_EQ(mesh.positions.size(), mesh.normals.size());
        for (const auto& t : mesh.triangles) {
            const Vec3 a = wide(mesh.positions[t[0]]), b = wide(mesh.positions[t[1]]), c = wide(mesh.positions[t[2]]);
            const Vec3 facet = glm::normalize(glm::cross(b - a, c - a));
            ASSERT_GT(glm::dot(facet, (a + b + c) / 3.0), 0.0) << each.name;
            for (const std::uint32_t index : t) {
                ASSERT_NEAR(glm::length(wide(mesh.normals[index])), 1.0, 1e-6) << each.name;
                ASSERT_GT(glm::dot(wide(mesh.normals[index]), facet), 0.98) << each.name;
            }
        }
    }
}

TEST(DrawnMesh, VerticesLieOnTheTrueSurface) {
    for (const Case& each : cases()) {
        if (each.distance == nullptr) {
            continue;
        }
        for (const auto& position : drawnMesh(*each.shape, true).positions) {
            const double distance = each.distance(*each.shape, wide(position));
            ASSERT_NEAR(distance, 0.0, 1e-6)
                << each.name << ' ' << position[0] << ' ' << position[1] << ' ' << position[2];
        }
    }
}

TEST(DrawnMesh, HoldsTheShapesOwnVertices) { // what collides is not drawn smaller than it is
    for (const Case& each : cases()) {
        const DrawnMesh mesh = drawnMesh(*each.shape, false);
        Vec3 low(1e9), high(-1e9);
        for (const auto& position : mesh.positions) {
            low = glm::min(low, wide(position));
            high = glm::max(high, wide(position));
        }
        const Vec3 size = high - low;
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(size[axis], each.shape->extents()[axis], 1e-6) << each.name;
        }
        for (const Vec3& vertex : each.shape->vertices()) {
            EXPECT_TRUE(glm::all(glm::lessThan(vertex, high + 1e-6)) && glm::all(glm::greaterThan(vertex, low - 1e-6)));
        }
    }
}

TEST(DrawnMesh, PatternUsesAllTintsAndTellsTheEndsApart) {
    for (const Case& each : cases()) {
        const DrawnMesh mesh = drawnMesh(*each.shape, true);
        ASSERT_EQ(mesh.tints.size(), mesh.triangles.size());
        const std::set<Tint> used(mesh.tints.begin(), mesh.tints.end());
        EXPECT_EQ(used.size(), kTintCount) << each.name;
        double lean = 0.0; // the accent's area, weighted by x: not the same at both ends
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            const auto& t = mesh.triangles[i];
            const Vec3 a = wide(mesh.positions[t[0]]), b = wide(mesh.positions[t[1]]), c = wide(mesh.positions[t[2]]);
            const double area = glm::length(glm::cross(b - a, c - a)) / 2.0;
            lean += mesh.tints[i] == Tint::Light ? area * (a.x + b.x + c.x) / 3.0 : 0.0;
        }
        EXPECT_GT(std::fabs(lean), 1e-3) << each.name;
    }
}

TEST(DrawnMesh, UnpatternedIsAllMain) {
    for (const Case& each : cases()) {
        const DrawnMesh mesh = drawnMesh(*each.shape, false);
        EXPECT_EQ(std::set<Tint>(mesh.tints.begin(), mesh.tints.end()), std::set<Tint>{Tint::Main}) << each.name;
    }
}

TEST(DrawnMesh, TintsAreColoursThatDiffer) {
    for (const Vec3& color : {Vec3(0.9, 0.3, 0.2), Vec3(0.1, 0.4, 0.6), Vec3(1.0), Vec3(0.0)}) {
        for (std::size_t i = 0; i < kTintCount; ++i) {
            const Vec3 tint = tintColor(static_cast<Tint>(i), color);
            EXPECT_TRUE(glm::all(glm::greaterThanEqual(tint, Vec3(0.0))) &&
                        glm::all(glm::lessThanEqual(tint, Vec3(1.0))));
        }
    }
    const Vec3 red(0.9, 0.3, 0.2);
    EXPECT_EQ(tintColor(Tint::Main, red), red);
    EXPECT_GT(tintColor(Tint::Light, red).y, 0.9);
    EXPECT_LT(tintColor(Tint::Accent, red).x, 0.6);
}

} // namespace
} // namespace elastoon
