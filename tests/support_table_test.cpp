// The table of furthest vertices against looking at all of them: also on the borders of its cells, and for shapes with
// so many vertices in a cell that it climbs.
#include "support_table.h"

#include "test_support.h"

namespace elastoon {
namespace {

std::vector<ShapePtr> shapesWithTables() {
    Random random(3);
    std::vector<Vec3> cloud;
    for (int i = 0; i < 30000; ++i) {
        cloud.push_back(random.direction());
    }
    return {valueOf(Shape::sphere(0.5, 8)),         valueOf(Shape::sphere(0.5, 16)),
            valueOf(Shape::cylinder(0.5, 1.0, 64)), valueOf(Shape::cone(1.0, 0.1, 256)),
            valueOf(Shape::capsule(0.01, 2.0, 16)), valueOf(Shape::hull(cloud))};
}

/// Any way, or to where cells meet: the components are quarters, or those of some table's borders.
Vec3 anyDirection(Random& random) {
    if (random.below(2) == 0) {
        return random.direction();
    }
    const int side = 1 + random.below(64);
    const auto border = [&] { return 2.0 * random.below(side + 1) / side - 1.0; };
    Vec3 direction(border(), border(), border());
    direction[random.below(3)] = random.below(2) == 0 ? 1.0 : -1.0;
    return direction * random.uniform(0.1, 10.0);
}

TEST(SupportTable, FindsTheFurthestVertex) {
    Random random(8);
    for (const ShapePtr& shape : shapesWithTables()) {
        const auto vertices = shape->vertices();
        ASSERT_FALSE(shape->supportTable().empty());
        for (int i = 0; i < 400 * soak(); ++i) {
            const Vec3 direction = anyDirection(random);
            double furthest = glm::dot(direction, vertices[0]);
            for (const Vec3& vertex : vertices) {
                furthest = std::max(furthest, glm::dot(direction, vertex));
            }
            const std::uint32_t found = shape->supportTable().furthest(vertices, shape->topology(), direction);
            ASSERT_NEAR(glm::dot(direction, vertices[found]), furthest,
                        1e-15 * glm::length(direction) * shape->boundingRadius())
                << vertices.size() << " vertices, case " << i;
        }
    }
}

TEST(SupportTable, NoDirectionIsNoCrash) {
    const ShapePtr ball = valueOf(Shape::sphere(0.5, 8));
    EXPECT_LT(ball->supportTable().furthest(ball->vertices(), ball->topology(), Vec3(0.0)), ball->vertices().size());
}

} // namespace
} // namespace elastoon
