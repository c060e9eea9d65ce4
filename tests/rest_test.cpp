// Coming to rest: in finite time, upright, exactly still; and waking.
#include "contact.h"
#include "test_support.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace elastoon {
namespace {

std::vector<ShapePtr> twelveShapes() {
    std::vector<Vec3> rock;
    Random random(5);
    for (int i = 0; i < 40; ++i) {
        rock.push_back(Vec3(0.6, 0.45, 0.5) * random.direction());
    }
    return {valueOf(Shape::sphere(0.5)),          valueOf(Shape::sphere(0.3, 4)),
            valueOf(Shape::box({1.0, 1.0, 1.0})), valueOf(Shape::box({0.2, 1.0, 0.7})),
            valueOf(Shape::box({1.5, 0.3, 0.3})), valueOf(Shape::cylinder(0.5, 0.6)),
            valueOf(Shape::cylinder(0.15, 1.5)),  valueOf(Shape::cone(0.4, 1.0)),
            valueOf(Shape::cone(0.8, 0.5)),       valueOf(Shape::capsule(0.25, 1.2)),
            valueOf(Shape::hull(rock)),           valueOf(Shape::box({2.0, 0.05, 1.0}))};
}

TEST(Rest, EveryShapeComesToItFromEveryPose) {
    Random random(51);
    const auto shapes = twelveShapes();
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        for (int i = 0; i < 50; ++i) {
            World world = worldWithFloor();
            BodyDef def;
            def.shape = shapes[s];
            def.style.restitution = 0.5;
            def.rotation = random.rotation();
            def.velocity = random.inBox(1.0);
            def.position = {0.0, 1.0 + 0.5 * def.shape->length(), 0.0};
            const BodyId body = valueOf(world.addBody(def));
            double last_apex = std::numeric_limits<double>::infinity();
            for (int k = 0; k < 60 * 6; ++k) {
                world.step(1.0 / 60.0);
                for (const PhaseBegun& begun : world.phasesBegun()) {
                    if (const auto* flight = begun.phase.as<Flight>()) {
                        const double rise = std::max(0.0, flight->velocity.y);
                        const double apex = flight->position.y + 0.5 * rise * rise / 9.81;
                        EXPECT_LE(apex, last_apex + def.shape->length()) << s << " " << i;
                        last_apex = apex;
                    }
                }
            }
            const bool rests = world.phase(body).is<Rest>();
            EXPECT_TRUE(rests) << s << " " << i;
            if (rests) {
                EXPECT_LT(world.phase(body).start, 5.0) << s << " " << i;
                const Pose pose = world.pose(body);
                EXPECT_NEAR(lowestPoint(*def.shape, pose), 0.0, 1e-9) << s << " " << i;
                EXPECT_NEAR(std::fabs((pose.orientation * Vec3(1, 0, 0)).y), 1.0, 1e-9) << "upright, " << s << " " << i;
                const std::uint64_t hash = world.stateHash();
                const Pose still = world.pose(body);
                world.step(7.0);
                EXPECT_EQ(world.pose(body).position, still.position);
                EXPECT_NE(world.stateHash(), hash) << "time goes on";
            }
        }
    }
}

/// Each side alone is too steep to hold anything; the two together hold all.
TEST(Rest, ComesInAGrooveOfTwoSteepSides) {
    Random random(52);
    const auto shapes = twelveShapes();
    for (const double degrees : {40.0, 45.0, 50.0}) {
        for (std::size_t s = 0; s < shapes.size(); ++s) {
            World world = worldWith();
            const double a = degrees * M_PI / 180.0;
            for (const double side : {-1.0, 1.0}) {
                (void)valueOf(world.addObstacle(ObstacleDef::plane({side * std::sin(a), std::cos(a), 0.0}, 0.0)));
            }
            BodyDef def;
            def.shape = shapes[s];
            def.style.restitution = 0.4;
            def.rotation = random.rotation();
            def.velocity = {0.3, 0.0, 0.0};
            def.position = {0.1, 3.0 + def.shape->boundingRadius() * 2.0, 0.0};
            const BodyId body = valueOf(world.addBody(def));
            for (int k = 0; k < 60 * 8; ++k) {
                world.step(1.0 / 60.0);
            }
            EXPECT_TRUE(world.phase(body).is<Rest>()) << degrees << " degrees, shape " << s;
        }
    }
}

} // namespace
} // namespace elastoon
