// Incidence told three ways agrees with the face loops, and the climb finds what looking at every vertex finds.
#include "topology.h"

#include "closest_support.h"

namespace elastoon {
namespace {

bool holds(std::span<const std::uint32_t> list, std::uint32_t what) {
    return std::find(list.begin(), list.end(), what) != list.end();
}

TEST(Topology, EdgesLieInTheLoopsOfTheirFaces) {
    for (const ShapePtr& shape : solids().all) {
        const Topology& topology = shape->topology();
        ASSERT_TRUE(topology.closed);
        EXPECT_EQ(shape->vertices().size() + shape->faceCount(), topology.edges.size() + 2);
        for (std::uint32_t face = 0; face < shape->faceCount(); ++face) {
            const auto loop = shape->face(face);
            const auto edges = topology.edgesOfFace(face);
            ASSERT_EQ(loop.size(), edges.size());
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const Topology::Edge& edge = topology.edges[edges[i]];
                const std::uint32_t next = loop[(i + 1) % loop.size()];
                const bool left = edge.left == face && edge.tail == loop[i] && edge.head == next;
                const bool right = edge.right == face && edge.head == loop[i] && edge.tail == next;
                EXPECT_TRUE(left != right);
            }
        }
    }
}

TEST(Topology, VerticesKnowTheirEdges) {
    for (const ShapePtr& shape : solids().all) {
        const Topology& topology = shape->topology();
        std::size_t ends = 0;
        for (std::uint32_t vertex = 0; vertex < shape->vertices().size(); ++vertex) {
            const auto edges = topology.edgesOfVertex(vertex);
            const auto neighbors = topology.neighborsOf(vertex);
            EXPECT_GE(edges.size(), 3U);
            ends += edges.size();
            for (std::size_t i = 0; i < edges.size(); ++i) {
                const Topology::Edge& edge = topology.edges[edges[i]];
                EXPECT_TRUE(edge.tail == vertex || edge.head == vertex);
                EXPECT_EQ(edge.tail + edge.head, vertex + neighbors[i]);
                EXPECT_TRUE(holds(topology.edgesOfFace(edge.left), edges[i]));
                EXPECT_TRUE(holds(topology.edgesOfFace(edge.right), edges[i]));
            }
        }
        EXPECT_EQ(ends, 2 * topology.edges.size());
    }
}

TEST(Topology, NormalsAreUnitOutwardAndAcrossTheirFaces) {
    for (const ShapePtr& shape : solids().all) {
        for (std::size_t face = 0; face < shape->faceCount(); ++face) {
            const Vec3& normal = shape->topology().face_normals[face];
            EXPECT_NEAR(glm::length(normal), 1.0, 1e-14);
            const Vec3 corner = shape->vertices()[shape->face(face)[0]];
            for (const Vec3& vertex : shape->vertices()) {
                EXPECT_LT(glm::dot(normal, vertex - corner), 1e-12);
            }
            for (const std::uint32_t vertex : shape->face(face)) {
                EXPECT_NEAR(glm::dot(normal, shape->vertices()[vertex] - corner), 0.0, 1e-12);
            }
        }
    }
}

TEST(Topology, ClimbReachesTheFurthestVertexFromEveryStart) {
    Random random(3);
    for (const ShapePtr& shape : solids().all) {
        for (int i = 0; i < 50; ++i) {
            const Vec3 direction = i < 6 ? Vec3(latticeRotation(4 * i)[0]) : random.direction();
            double furthest = glm::dot(direction, shape->vertices()[0]);
            for (const Vec3& vertex : shape->vertices()) {
                furthest = std::max(furthest, glm::dot(direction, vertex));
            }
            const double support = glm::dot(direction, shape->vertices()[shape->supportVertex(direction)]);
            EXPECT_NEAR(support, furthest, 1e-15);
            for (std::uint32_t start = 0; start < shape->vertices().size(); ++start) {
                const std::uint32_t found = climb(shape->vertices(), shape->topology(), direction, start);
                EXPECT_NEAR(glm::dot(direction, shape->vertices()[found]), furthest, 1e-15);
            }
        }
    }
}

TEST(Topology, OurOwnShapesAreClimbed) {
    for (const ShapePtr& shape :
         {valueOf(Shape::sphere(0.5, 64)), valueOf(Shape::cylinder(0.5, 1.0, 256)), valueOf(Shape::cone(1.0, 0.1, 256)),
          valueOf(Shape::capsule(0.01, 10.0, 64)), valueOf(Shape::box({1.0, 1e-6, 1e-6}))}) {
        EXPECT_TRUE(shape->topology().climbable) << nameOf(shape->kind());
    }
}

/// Two corners 5e-11 apart, where the hull is convex to 1e-11 only: climbing would stop on the wrong one.
TEST(Topology, TheFurthestVertexIsFoundPastCornersNextToEachOther) {
    const std::vector<Vec3> points{{9 + 3e-11, 1, 10}, {0, 3e-11, 0}, {0, 0, 2},     {5, 0, 1.0 / 3.0}, {2, 5, 0},
                                   {1, 44, 5},         {1, 0, 2},     {4e-11, 0, 0}, {0, 9, 9},         {3, 1, 0}};
    const ShapePtr shape = valueOf(Shape::hull(points));
    EXPECT_TRUE(shape->topology().closed);
    EXPECT_FALSE(shape->topology().climbable);
    const auto vertices = shape->vertices();
    Random random(5);
    for (int i = 0; i < 3000; ++i) {
        const Vec3 direction = random.direction();
        const double top = glm::dot(direction, vertices[shape->supportVertex(direction)]);
        for (std::uint32_t start = 0; start < vertices.size(); ++start) {
            const std::uint32_t found = climb(vertices, shape->topology(), direction, start);
            EXPECT_NEAR(glm::dot(direction, vertices[found]), top, 1e-9);
        }
    }
}

TEST(Topology, AnOpenSurfaceIsToldAndClimbedByLookingEverywhere) {
    const ShapePtr box = solids().small[0];
    std::vector<std::uint32_t> loops;
    std::vector<std::uint32_t> begin{0};
    for (std::size_t face = 1; face < box->faceCount(); ++face) {
        loops.insert(loops.end(), box->face(face).begin(), box->face(face).end());
        begin.push_back(static_cast<std::uint32_t>(loops.size()));
    }
    const Topology open = topologyOf(box->vertices(), loops, begin);
    EXPECT_FALSE(open.closed);
    const Vec3 direction(0.3, -0.5, 0.7);
    EXPECT_EQ(climb(box->vertices(), open, direction, 0), box->supportVertex(direction));
}

} // namespace
} // namespace elastoon
