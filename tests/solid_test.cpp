// Bodies among convex solids: they touch in time, do not enter, keep contact, rest on top, and fall off the ends.
#include "contact.h"
#include "flight.h"
#include "test_support.h"
#include "touch.h"
#include "witness_support.h"

#include <cmath>

namespace elastoon {
namespace {

ObstacleDef solidDef(const ShapePtr& shape, const Vec3& position, const Quat& rotation = kNoRotation) {
    ObstacleDef def;
    def.shape = shape;
    def.position = position;
    def.rotation = rotation;
    return def;
}

TEST(Solid, BallOnABoxBouncesAsOnAPlane) {
    World on_plane = worldWithFloor();
    World on_box = worldWith();
    (void)valueOf(on_box.addObstacle(solidDef(valueOf(Shape::box({10.0, 2.0, 10.0})), {0.0, -1.0, 0.0})));
    BodyDef def;
    def.shape = valueOf(Shape::sphere(0.5));
    def.position = {0.0, 5.0, 0.0};
    const BodyId a = valueOf(on_plane.addBody(def));
    const BodyId b = valueOf(on_box.addBody(def));
    for (int i = 0; i < 600; ++i) {
        on_plane.step(1.0 / 60.0);
        on_box.step(1.0 / 60.0);
        ASSERT_LT(glm::length(on_plane.pose(a).position - on_box.pose(b).position), 1e-6) << i;
    }
    EXPECT_EQ(nameOf(on_box.phase(b)), "rest");
}

TEST(Solid, NothingTunnelsThroughAThinWall) {
    const ShapePtr grain = valueOf(Shape::sphere(0.005));
    const ShapePtr wall = valueOf(Shape::box({0.001, 2.0, 2.0}));
    Random random(31);
    for (int i = 0; i < 200; ++i) {
        World world = worldWith();
        (void)valueOf(world.addObstacle(solidDef(wall, {3.0, 0.0, 0.0})));
        BodyDef def;
        def.shape = grain;
        def.style.max_stretch = 1.5;
        def.position = {random.uniform(-30.0, 2.0), random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3)};
        def.velocity = {1000.0, random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0)};
        const BodyId body = valueOf(world.addBody(def));
        for (int k = 0; k < 3; ++k) {
            world.step(1.0 / 24.0);
            ASSERT_LT(world.pose(body).position.x, 3.0) << i;
        }
    }
}

TEST(Solid, FirstTouchIsTheFirstAndLeavesAHairOfAir) {
    Random random(32);
    const ShapePtr bodies[] = {valueOf(Shape::sphere(0.5, 4)), valueOf(Shape::cylinder(0.2, 1.5, 12)),
                               valueOf(Shape::cone(0.5, 1.0, 12)), valueOf(Shape::box({0.1, 1.0, 0.5}))};
    const ShapePtr solids[] = {valueOf(Shape::box({2.0, 1.0, 2.0})), valueOf(Shape::cylinder(0.5, 3.0, 16)),
                               valueOf(Shape::sphere(1.0, 4)), valueOf(Shape::cone(1.0, 1.5, 12))};
    int touches = 0;
    constexpr int kCases = 400;
    for (int i = 0; i < kCases; ++i) {
        const ShapePtr& body = bodies[i % 4];
        const ShapePtr& solid = solids[i / 4 % 4];
        MovingFrame frame;
        frame.orientation = random.rotation();
        frame.velocity = i % 3 == 0 ? random.inBox(1.0) : Vec3(0.0);
        frame.angular_velocity = i % 5 == 0 ? random.inBox(1.0) : Vec3(0.0);
        const Vec3 start = 5.0 * random.direction();
        Phase phase;
        phase.motion =
            beginFlight({start, random.rotation(), 1.0}, -start + random.inBox(2.0), {0, -2, 0}, Style{}, Lead::PlusX);
        ClosestSeed seed;
        const auto touch = firstSolidTouch(phase, *body, solid, frame, 0.0, 2.0, seed);
        touches += touch ? 1 : 0;
        const double until = touch ? touch->time : 2.0;
        const auto gapAt = [&](double t) {
            return separation(*body, poseAt(phase, *body, t), *solid, {frame.originAt(t), frame.orientationAt(t), 1.0});
        };
        for (int k = 0; k <= 20; ++k) {
            EXPECT_GT(gapAt(until * k / 20.0), -1e-9) << i;
        }
        if (touch) {
            EXPECT_LT(gapAt(until), 1e-6) << i;
            EXPECT_GT(
                glm::dot(touch->surface.normalAt(until), poseAt(phase, *body, until).position - frame.originAt(until)),
                0.0);
        }
    }
    EXPECT_GT(touches, kCases * 3 / 10);
    EXPECT_LT(touches, kCases * 9 / 10);
}

TEST(Solid, ContactIsTheMiddleOfTheCommonRegion) {
    const ShapePtr slab = valueOf(Shape::box({4.0, 1.0, 4.0}));
    const ShapePtr box = valueOf(Shape::box({1.0, 1.0, 1.0}));
    Surface top;
    top.point = {0.0, 0.5, 0.0};
    top.solid = slab;
    const auto contact = [&](const Vec3& position, const Quat& q) {
        return contactPoint(*box, {position, q, 1.0}, top, 0.0);
    };
    EXPECT_LT(glm::length(contact({0.3, 1.0, 0.1}, kNoRotation) - Vec3(0.3, 0.5, 0.1)), 1e-12) << "face within face";
    EXPECT_LT(glm::length(contact({2.0, 1.0, 0.0}, kNoRotation) - Vec3(1.75, 0.5, 0.0)), 1e-12) << "half over the edge";
    const Quat tilt(std::cos(M_PI / 8), 0.0, 0.0, std::sin(M_PI / 8));
    const Vec3 edge = contact({2.0, 0.5 + std::sqrt(0.5), 2.0}, tilt);
    EXPECT_LT(glm::length(edge - Vec3(2.0, 0.5, 1.75)), 1e-9) << "an edge that sticks out";
}

TEST(Solid, RandomBouncesHoldTheirBounds) {
    Random random(33);
    const ShapePtr bodies[] = {valueOf(Shape::sphere(0.5, 4)), valueOf(Shape::cylinder(0.2, 1.5, 12)),
                               valueOf(Shape::cone(0.5, 1.0, 12)), valueOf(Shape::box({0.3, 1.0, 0.5})),
                               valueOf(Shape::capsule(0.25, 1.6, 8))};
    const ShapePtr solids[] = {valueOf(Shape::box({3.0, 1.0, 3.0})), valueOf(Shape::cylinder(0.7, 3.0, 16)),
                               valueOf(Shape::sphere(1.2, 4)), valueOf(Shape::cone(1.2, 1.5, 12))};
    const int cases = 120 * soak();
    int impacts = 0;
    for (int i = 0; i < cases; ++i) {
        const ShapePtr& shape = bodies[i % 5];
        const ShapePtr& solid = solids[i % 4];
        World world = worldWith();
        ObstacleDef obstacle = solidDef(solid, Vec3(0.0), i % 2 == 0 ? kNoRotation : random.rotation());
        obstacle.velocity = i % 3 == 0 ? random.inBox(0.5) : Vec3(0.0);
        obstacle.angular_velocity = i % 6 == 0 ? random.inBox(0.2) : Vec3(0.0);
        const ObstacleId id = valueOf(world.addObstacle(obstacle));
        BodyDef def;
        def.shape = shape;
        def.position = {random.uniform(-1.0, 1.0), random.uniform(3.0, 5.0), random.uniform(-1.0, 1.0)};
        def.velocity = random.inBox(1.5);
        def.style.restitution = random.uniform(0.2, 0.9);
        def.style.max_stretch = random.uniform(1.1, 2.5);
        def.style.min_squash = random.uniform(0.3, 0.9);
        (void)valueOf(world.addBody(def));
        Timeline timeline;
        timeline.begin(world);
        for (int k = 0; k < 150; ++k) {
            world.step(1.0 / 50.0);
            timeline.capture(world);
        }
        const auto& phases = timeline.tracks()[0].phases();
        const MovingFrame frame = world.frame(id);
        for (std::size_t p = 0; p < phases.size(); ++p) {
            const double end = p + 1 < phases.size() ? phases[p + 1].start : world.time();
            const bool held = phases[p].motion.index() != 0;
            impacts += phases[p].motion.index() == 1 ? 1 : 0;
            for (int k = 0; k <= 12; ++k) {
                const double t = phases[p].start + (end - phases[p].start) * k / 12;
                const double gap = separation(*shape, poseAt(phases[p], *shape, t), *solid,
                                              {frame.originAt(t), frame.orientationAt(t), 1.0});
                EXPECT_GT(gap, -1e-5) << i << " " << nameOf(phases[p]) << " at " << t;
                if (held) {
                    EXPECT_LT(gap, 1e-4) << i << " " << nameOf(phases[p]) << " at " << t;
                }
            }
            if (p > 0) {
                const Pose before = poseAt(phases[p - 1], *shape, phases[p].start);
                const Pose after = poseAt(phases[p], *shape, phases[p].start);
                EXPECT_LT(glm::length(before.position - after.position), 1e-6 * shape->length())
                    << i << " " << nameOf(phases[p]);
                EXPECT_LT(angleBetween(before.orientation, after.orientation), 1e-6) << i;
            }
        }
    }
    EXPECT_GT(impacts, cases / 2);
}

TEST(Solid, StartInsideIsRefusedAndMeasured) {
    World world = worldWith();
    (void)valueOf(world.addObstacle(solidDef(valueOf(Shape::box(Vec3(2.0))), Vec3(0.0))));
    BodyDef def;
    def.shape = valueOf(Shape::box(Vec3(1.0)));
    def.position = {0.0, 1.4, 0.0};
    const auto overlap = world.overlapOf(def);
    ASSERT_TRUE(overlap.has_value());
    EXPECT_NEAR(overlap->depth, 0.1, 1e-9);
    EXPECT_LT(glm::length(overlap->normal - Vec3(0, 1, 0)), 1e-12);
    EXPECT_FALSE(world.addBody(def).ok());
    def.position.y = 1.6;
    EXPECT_TRUE(world.addBody(def).ok());
}

} // namespace
} // namespace elastoon
