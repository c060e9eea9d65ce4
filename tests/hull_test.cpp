// The hull against its definition, on point sets that break hulls.
#include "hull.h"
#include "test_support.h"

#include <limits>

namespace elastoon {
namespace {

/// Everything inside every face's plane, every face a convex loop, Euler's formula.
void expectHullOf(const Polytope& hull, const std::vector<Vec3>& points, double size) {
    std::size_t sides = 0;
    const std::size_t faces = hull.face_begin.size() - 1;
    for (std::size_t f = 0; f < faces; ++f) {
        const std::uint32_t begin = hull.face_begin[f];
        const std::uint32_t count = hull.face_begin[f + 1] - begin;
        sides += count;
        Vec3 normal(0.0);
        const auto at = [&](std::uint32_t i) { return hull.vertices[hull.face_vertices[begin + i % count]]; };
        for (std::uint32_t i = 1; i + 1 < count; ++i) {
            normal += glm::cross(at(i) - at(0), at(i + 1) - at(0));
        }
        normal = glm::normalize(normal);
        for (const Vec3& point : points) {
            EXPECT_LT(glm::dot(normal, point - at(0)), 1e-10 * size);
        }
        for (std::uint32_t i = 0; i < count; ++i) {
            EXPECT_GT(glm::dot(normal, glm::cross(at(i + 1) - at(i), at(i + 2) - at(i + 1))), -1e-10 * size * size);
        }
    }
    EXPECT_EQ(hull.vertices.size() + faces, sides / 2 + 2);
}

TEST(Hull, OfRandomPointsHoldsThemAll) {
    Random random(11);
    for (int i = 0; i < 300; ++i) {
        std::vector<Vec3> points;
        const double size = std::pow(10.0, random.uniform(-8.0, 8.0));
        for (int j = 0; j < 5 + random.below(200); ++j) {
            points.push_back(size * (i % 2 == 0 ? random.inBox(1.0) : random.direction()));
        }
        auto hull = convexHull(points);
        ASSERT_TRUE(hull.ok()) << hull.error().text();
        expectHullOf(hull.value(), points, size);
    }
}

TEST(Hull, MergesLatticesIntoTheirBox) {
    std::vector<Vec3> points;
    for (int copy = 0; copy < 2; ++copy) {
        for (int x = 0; x < 5; ++x) {
            for (int y = 0; y < 5; ++y) {
                for (int z = 0; z < 5; ++z) {
                    points.emplace_back(0.1 * x, 0.3 * y, 0.7 * z);
                }
            }
        }
    }
    const Polytope hull = valueOf(convexHull(points));
    EXPECT_EQ(hull.vertices.size(), 8U);
    EXPECT_EQ(hull.face_begin.size(), 7U);
    expectHullOf(hull, points, 3.0);
}

TEST(Hull, SaysWhatFlatPointsSpan) {
    const auto messageOf = [](const std::vector<Vec3>& points) { return convexHull(points).error().message; };
    EXPECT_NE(messageOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).find("at least 4"), std::string::npos);
    EXPECT_NE(messageOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}).find("one plane"), std::string::npos);
    EXPECT_NE(messageOf({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}).find("one line"), std::string::npos);
    EXPECT_NE(messageOf({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}).find("1e-9"), std::string::npos);
    EXPECT_NE(
        messageOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, std::numeric_limits<double>::infinity()}}).find("finite"),
        std::string::npos);
}

} // namespace
} // namespace elastoon
