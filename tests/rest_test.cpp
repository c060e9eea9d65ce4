// Coming to rest: in finite time, upright, exactly still; and waking.
#include "contact.h"
#include "test_support.h"

#include <algorithm>
#include <cmath>

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
            double last_apex = 1e9;
            std::vector<Event> events;
            for (int k = 0; k < 60 * 6; ++k) {
                world.step(1.0 / 60.0);
                events.insert(events.end(), world.events().begin(), world.events().end());
            }
            (void)last_apex;
            const bool rests = std::holds_alternative<Rest>(world.phase(body).motion);
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

} // namespace
} // namespace elastoon
