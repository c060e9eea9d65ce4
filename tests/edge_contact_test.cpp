// A body that comes down on an edge, against contactAlong(), which knows nothing of edges.
#include "edge_contact.h"

#include "closest_support.h"
#include "dmath.h"

namespace elastoon {
namespace {

struct EdgeCase {
    Surface surface;
    Pose pose;
};

/// Somewhere over some edge of the solid, the surface's normal between those of its faces, or nearly; sometimes past
/// the edge's end, or where another feature is met first.
EdgeCase anyEdgeCase(Random& random, const ShapePtr& solid, const Shape& body) {
    const Topology& topology = solid->topology();
    const auto& edge = topology.edges[static_cast<std::size_t>(random.below(static_cast<int>(topology.edges.size())))];
    const Vec3& tail = solid->vertices()[edge.tail];
    const Vec3 way = solid->vertices()[edge.head] - tail;
    const double share = random.uniform(0.05, 0.95);
    EdgeCase made;
    made.surface.solid = solid;
    made.surface.point = tail + share * way;
    const double mix = random.uniform(0.05, 0.95);
    const double tilt = random.below(2) == 0 ? 0.0 : random.uniform(-5e-4, 5e-4);
    made.surface.normal = glm::normalize(mix * topology.face_normals[edge.left] +
                                         (1.0 - mix) * topology.face_normals[edge.right] + tilt * glm::normalize(way));
    made.pose.orientation = random.rotation();
    made.pose.stretch = random.uniform(0.5, 2.0);
    made.pose.position = made.surface.point + made.surface.normal * random.uniform(0.0, 3.0) +
                         random.inBox(random.below(2) == 0 ? 0.05 : 0.4) * body.length();
    return made;
}

TEST(EdgeContact, IsWhatContactAlongFinds) {
    Random random(51);
    int found = 0;
    int cases = 0;
    for (int i = 0; i < 4000 * soak(); ++i) {
        const ShapePtr body = anyOf(random, solids().all);
        const ShapePtr solid = anyOf(random, solids().all);
        const EdgeCase c = anyEdgeCase(random, solid, *body);
        ++cases;
        const auto contact = contactOnEdge(c.surface, *body, c.pose);
        if (!contact) {
            continue;
        }
        ++found;
        const PosedShape a{body.get(), linearOf(c.pose), c.pose.position};
        const PosedShape b{solid.get(), Mat3(1.0), Vec3(0.0)};
        const auto along = contactAlong(a, b, c.surface.normal);
        ASSERT_TRUE(along) << "case " << i;
        const double size = sizeOf(a, b);
        const double sine = glm::dot(contact->normal, c.surface.normal);
        EXPECT_NEAR(glm::length(contact->normal), 1.0, 1e-14);
        EXPECT_NEAR(contact->shift, along->shift, 1e-13 * size / sine) << "case " << i;
        PosedShape moved = a;
        moved.position += contact->shift * c.surface.normal;
        EXPECT_NEAR(gapAcross(moved, b, contact->normal), 0.0, 1e-13 * size) << "case " << i;
    }
    EXPECT_GT(found, cases / 4);
}

/// Leaning, over a face and beyond its borders, or over an edge and beyond both of its faces.
TEST(EdgeContact, OffTheFaceIsWhatContactAlongFinds) {
    Random random(52);
    int on_face = 0;
    int missed = 0;
    for (int i = 0; i < 6000 * soak(); ++i) {
        const ShapePtr body = anyOf(random, solids().all);
        const ShapePtr solid = anyOf(random, solids().all);
        EdgeCase c = anyEdgeCase(random, solid, *body);
        if (random.below(2) == 0) {
            const auto face =
                static_cast<std::size_t>(random.below(static_cast<int>(solid->topology().face_normals.size())));
            c.surface.normal = solid->topology().face_normals[face];
            c.surface.point = solid->vertices()[solid->face(face)[0]];
            c.pose.position = c.surface.point + c.surface.normal + random.inBox(0.6) * solid->length();
        } else {
            c.pose.position += random.inBox(0.5) * solid->length();
        }
        const PosedShape a{body.get(), linearOf(c.pose), c.pose.position};
        const PosedShape b{solid.get(), Mat3(1.0), Vec3(0.0)};
        const auto along = contactAlong(a, b, c.surface.normal);
        const auto contact = contactOffFace(c.surface, *body, c.pose);
        ASSERT_EQ(contact.has_value(), along.has_value()) << "case " << i;
        missed += contact ? 0 : 1;
        if (!contact) {
            continue;
        }
        const double size = sizeOf(a, b);
        const double sine = glm::dot(contact->normal, c.surface.normal);
        ASSERT_NEAR(contact->shift, along->shift, 1e-12 * size / std::max(sine, 1e-3)) << "case " << i;
        PosedShape moved = a;
        moved.position += contact->shift * c.surface.normal;
        ASSERT_NEAR(gapAcross(moved, b, contact->normal), 0.0, 1e-12 * size) << "case " << i;
        for (std::size_t face = 0; face < solid->topology().face_normals.size(); ++face) {
            if (const auto found = contactOnFace(*solid, face, *body, c.pose, c.surface.normal)) {
                ASSERT_NEAR(found->shift, along->shift, 1e-12 * size / glm::dot(found->normal, c.surface.normal));
                ++on_face;
            }
        }
    }
    EXPECT_GT(missed, 100);
    EXPECT_GT(on_face, 600);
}

/// A cube face down on the edge of a box, at half of a right angle to both of its faces.
TEST(EdgeContact, ClosedForm) {
    const ShapePtr box = valueOf(Shape::box({2.0, 2.0, 2.0}));
    const ShapePtr body = valueOf(Shape::box({0.5, 0.5, 0.5}));
    Surface surface;
    surface.solid = box;
    surface.point = {1.0, 1.0, 0.3};
    surface.normal = glm::normalize(Vec3(1.0, 1.0, 0.0));
    Pose pose;
    pose.position = {3.0, 3.0, 0.3};
    pose.orientation = glm::normalize(Quat(std::cos(kPi / 8.0), 0.0, 0.0, std::sin(kPi / 8.0)));
    const auto contact = contactOnEdge(surface, *body, pose);
    ASSERT_TRUE(contact);
    EXPECT_NEAR(contact->shift, -(2.0 * std::sqrt(2.0) - 0.25), 1e-14);
    EXPECT_NEAR(glm::length(contact->normal - surface.normal), 0.0, 1e-14);
    pose.position.z = 1.4;
    EXPECT_FALSE(contactOnEdge(surface, *body, pose)) << "past the edge's end";
}

} // namespace
} // namespace elastoon
