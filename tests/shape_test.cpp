// Every solid: centroid at the origin, exact extents, its volume against the formula, and refusals that say why.
#include "elastoon/shape.h"

#include "test_support.h"

#include <cmath>
#include <limits>

namespace elastoon {
namespace {

/// Volume and centroid by tetrahedra about another point, unlike the library's own sum.
std::pair<double, Vec3> massOf(const Shape& shape) {
    const Vec3 base = shape.boundingRadius() * Vec3(0.3, -0.5, 0.7);
    double volume = 0.0;
    Vec3 moment(0.0);
    for (std::size_t i = 0; i < shape.faceCount(); ++i) {
        const auto face = shape.face(i);
        for (std::size_t j = 1; j + 1 < face.size(); ++j) {
            const Vec3 a = shape.vertices()[face[0]] - base;
            const Vec3 b = shape.vertices()[face[j]] - base;
            const Vec3 c = shape.vertices()[face[j + 1]] - base;
            const double part = glm::dot(a, glm::cross(b, c)) / 6.0;
            volume += part;
            moment += part * (a + b + c) / 4.0;
        }
    }
    return {volume, base + moment / volume};
}

void expectSound(const Shape& shape, const Vec3& extents) {
    const auto [volume, centroid] = massOf(shape);
    const double size = shape.boundingRadius();
    EXPECT_LT(glm::length(centroid), 1e-12 * size) << nameOf(shape.kind());
    EXPECT_NEAR(volume / shape.volume(), 1.0, 1e-12);
    EXPECT_LT(glm::length(shape.extents() - extents), 1e-14 * size) << nameOf(shape.kind());
    EXPECT_EQ(shape.length(), shape.extents().x);
    // Euler: V - E + F = 2, with E = half the sum of the faces' sides.
    std::size_t sides = 0;
    for (std::size_t i = 0; i < shape.faceCount(); ++i) {
        sides += shape.face(i).size();
    }
    EXPECT_EQ(shape.vertices().size() + shape.faceCount(), sides / 2 + 2) << nameOf(shape.kind());
}

TEST(Shape, SolidsAreSound) {
    expectSound(*valueOf(Shape::sphere(0.5)), Vec3(1.0));
    expectSound(*valueOf(Shape::sphere(2.0, 16)), Vec3(4.0));
    expectSound(*valueOf(Shape::box({1.0, 2.0, 3.0})), Vec3(1.0, 2.0, 3.0));
    expectSound(*valueOf(Shape::cylinder(0.5, 3.0)), Vec3(3.0, 1.0, 1.0));
    expectSound(*valueOf(Shape::cone(0.5, 3.0)), Vec3(3.0, 1.0, 1.0));
    expectSound(*valueOf(Shape::capsule(0.5, 3.0)), Vec3(3.0, 1.0, 1.0));
    expectSound(*valueOf(Shape::capsule(0.5, 1.0)), Vec3(1.0));
    expectSound(*valueOf(Shape::box({1e-9, 1e-9, 1e-9})), Vec3(1e-9));
    expectSound(*valueOf(Shape::sphere(5e8)), Vec3(1e9));
}

TEST(Shape, CountsOfVerticesAndFaces) {
    EXPECT_EQ(valueOf(Shape::sphere(1.0))->vertices().size(), 258U);
    EXPECT_EQ(valueOf(Shape::sphere(1.0, 16))->vertices().size(), 1026U);
    EXPECT_EQ(valueOf(Shape::box(Vec3(1.0)))->faceCount(), 6U) << "coplanar triangles are one face";
    const ShapePtr cylinder = valueOf(Shape::cylinder(1.0, 2.0));
    EXPECT_EQ(cylinder->vertices().size(), 64U);
    EXPECT_EQ(cylinder->faceCount(), 34U);
    EXPECT_EQ(valueOf(Shape::cone(1.0, 2.0))->faceCount(), 33U);
}

TEST(Shape, VolumesTendToTheTrueSolids) {
    EXPECT_NEAR(valueOf(Shape::sphere(1.0, 64))->volume() / (4.0 / 3.0 * M_PI), 1.0, 2e-3);
    EXPECT_NEAR(valueOf(Shape::cylinder(1.0, 2.0, 256))->volume() / (2.0 * M_PI), 1.0, 2e-4);
    EXPECT_NEAR(valueOf(Shape::cone(1.0, 3.0, 256))->volume() / M_PI, 1.0, 2e-4);
    EXPECT_NEAR(valueOf(Shape::capsule(1.0, 4.0, 64))->volume() / (2.0 * M_PI + 4.0 / 3.0 * M_PI), 1.0, 3e-3);
}

TEST(Shape, HullMovesItsCentroidToTheOrigin) {
    Random random(9);
    for (int i = 0; i < 200; ++i) {
        const Vec3 offset = random.inBox(5.0);
        std::vector<Vec3> points;
        for (int j = 0; j < 4 + random.below(60); ++j) {
            points.push_back(offset + random.inBox(1.0));
        }
        const ShapePtr hull = valueOf(Shape::hull(points));
        EXPECT_LT(glm::length(massOf(*hull).second), 1e-11);
        for (const Vec3& vertex : hull->vertices()) {
            const bool given = std::any_of(points.begin(), points.end(), [&](const Vec3& p) {
                return glm::length(p - hull->centroidOfInput() - vertex) < 1e-12;
            });
            EXPECT_TRUE(given);
        }
    }
}

TEST(Shape, SupportIsTheFurthestVertex) {
    const ShapePtr shape = valueOf(Shape::capsule(0.4, 2.0));
    Random random(10);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 d = random.direction();
        const double reach = glm::dot(d, shape->vertices()[shape->supportVertex(d)]);
        for (const Vec3& vertex : shape->vertices()) {
            EXPECT_LE(glm::dot(d, vertex), reach + 1e-15);
        }
    }
}

TEST(Shape, BadSizesAreRefusedByName) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(Shape::sphere(0.0).error().where, "radius");
    EXPECT_EQ(Shape::sphere(nan).error().where, "radius");
    EXPECT_EQ(Shape::sphere(1.0, 7).error().where, "cuts");
    EXPECT_EQ(Shape::box({1.0, -1.0, 1.0}).error().where, "size");
    EXPECT_EQ(Shape::cylinder(1.0, 1e10).error().where, "length");
    EXPECT_EQ(Shape::cylinder(1.0, 1.0, 10).error().where, "sides");
    EXPECT_EQ(Shape::capsule(1.0, 1.9).error().where, "length");
    EXPECT_FALSE(Shape::cone(std::numeric_limits<double>::infinity(), 1.0).ok());
}

} // namespace
} // namespace elastoon
