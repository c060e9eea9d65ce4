// Impacts at all angles: continuous, without slip, without gap or penetration, turning by the smallest way.
#include "impact.h"

#include "contact.h"
#include "rotation.h"
#include "test_support.h"

#include <cmath>
#include <limits>

namespace elastoon {
namespace {

struct Case {
    BodyDef def;
    ObstacleDef floor = ObstacleDef::plane({0, 1, 0}, 0.0);
};

Case randomCase(Random& random, int i) {
    static const ShapePtr shapes[] = {valueOf(Shape::sphere(0.5)), valueOf(Shape::cylinder(0.2, 1.5)),
                                      valueOf(Shape::cone(0.5, 1.0)), valueOf(Shape::box({0.3, 1.0, 0.5})),
                                      valueOf(Shape::capsule(0.25, 1.6))};
    Case c;
    c.def.shape = shapes[i % 5];
    c.def.position = {0.0, random.uniform(3.0, 8.0), 0.0};
    c.def.velocity = {random.uniform(-8.0, 8.0), random.uniform(-8.0, 4.0), random.uniform(-8.0, 8.0)};
    c.def.rotation = random.rotation();
    c.def.style.restitution = random.uniform(0.0, 1.0);
    c.def.style.max_stretch = random.uniform(1.0, 3.0);
    c.def.style.min_squash = random.uniform(0.2, 1.0);
    c.def.style.stretch_rate = random.uniform(0.02, 0.3);
    c.def.style.squash_rate = random.uniform(0.5, 2.0);
    c.def.style.squash_law = random.below(2) == 0 ? SquashLaw::Paper : SquashLaw::Bounded;
    c.def.style.impact_easing = random.below(2) == 0 ? ImpactEasing::Smooth : ImpactEasing::Linear;
    if (i % 3 == 0) {
        c.floor = ObstacleDef::plane(glm::normalize(Vec3(random.uniform(-1, 1), 1.0, random.uniform(-1, 1))), 0.0);
    }
    if (i % 4 == 0) {
        c.floor.velocity = random.inBox(1.0);
    }
    if (i % 8 == 0) {
        c.floor.angular_velocity = random.inBox(0.2);
    }
    return c;
}

double gapOf(const Shape& shape, const Phase& phase, const Surface& surface, double t) {
    return gapTo(surface, shape, poseAt(phase, shape, t), t) / shape.length();
}

TEST(Impact, HoldsItsBoundsInRandomBounces) {
    Random random(17);
    int impacts = 0;
    for (int i = 0; i < 400; ++i) {
        const Case c = randomCase(random, i);
        World world = worldWith();
        const ObstacleId floor = valueOf(world.addObstacle(c.floor));
        const BodyId body = valueOf(world.addBody(c.def));
        const Shape& shape = *c.def.shape;
        Timeline timeline;
        timeline.begin(world);
        for (int k = 0; k < 120; ++k) {
            world.step(0.05);
            timeline.capture(world);
        }
        Surface plane;
        plane.frame = world.frame(floor);
        plane.normal = world.planeNormal(floor);
        const auto& phases = timeline.tracks().at(0).phases();
        for (std::size_t p = 0; p < phases.size(); ++p) {
            const Phase& phase = phases[p];
            const double end = p + 1 < phases.size() ? phases[p + 1].start : world.time();
            for (int k = 0; k <= 20; ++k) {
                EXPECT_GT(gapOf(shape, phase, plane, phase.start + (end - phase.start) * k / 20), -1e-9) << i;
            }
            if (p > 0) {
                const Pose before = poseAt(phases[p - 1], shape, phase.start);
                const Pose after = poseAt(phase, shape, phase.start);
                EXPECT_LT(glm::length(before.position - after.position), 1e-8 * shape.length()) << i;
                EXPECT_NEAR(before.stretch, after.stretch, 1e-9) << i;
                EXPECT_LT(angleBetween(before.orientation, after.orientation), 1e-9) << i;
            }
            const auto* impact = phase.as<Impact>();
            if (impact == nullptr) {
                continue;
            }
            ++impacts;
            for (int k = 0; k <= 20; ++k) {
                const double t = phase.start + (end - phase.start) * k / 20;
                EXPECT_LT(gapOf(shape, phase, plane, t), 1e-4) << "stays in contact";
                // Stick: the material point under the contact moves along the normal only.
                const Vec3 drift = worldFromShape(poseAt(phase, shape, t), impact->contact_in_shape) -
                                   impact->surface.pointAt(t) -
                                   impact->surface.frame.orientationAt(t) * impact->skims * (t - impact->begun);
                const Vec3 n = impact->surface.normalAt(t);
                EXPECT_LT(glm::length(drift - n * glm::dot(n, drift)), 1e-6 * shape.length()) << i;
            }
        }
        EXPECT_TRUE(world.contains(body));
    }
    EXPECT_GT(impacts, 400);
}

TEST(Impact, ReflectsAsThePaperSays) {
    Random random(18);
    for (int i = 0; i < 300; ++i) {
        const Case c = randomCase(random, 4 * i + 1);
        World world = worldWith({0, 0, 0});
        ObstacleDef floor = ObstacleDef::plane({0, 1, 0}, 0.0);
        floor.velocity = i % 2 == 0 ? Vec3(0.0) : random.inBox(1.0);
        (void)valueOf(world.addObstacle(floor));
        BodyDef def = c.def;
        def.velocity.y = -random.uniform(2.0, 9.0);
        const BodyId body = valueOf(world.addBody(def));
        for (int k = 0; k < 4000 && (world.events().empty() || world.events().back().type != EventType::Release); ++k) {
            world.step(0.01);
        }
        ASSERT_FALSE(world.events().empty());
        Vec3 relative = def.velocity - floor.velocity;
        relative.y *= -def.style.restitution;
        EXPECT_LT(glm::length(world.velocity(body) - (floor.velocity + relative)), 1e-9) << i;
    }
}

TEST(Impact, SwapsTheForwardEndAndTurnsByTheSmallestWay) {
    // 45 degrees onto a floor with r = 1: the trailing end becomes the leading one, after a quarter turn through n.
    World world = worldWith({0, 0, 0});
    (void)valueOf(world.addObstacle(ObstacleDef::plane({0, 1, 0}, 0.0)));
    BodyDef def;
    def.shape = valueOf(Shape::cylinder(0.2, 1.0));
    def.style.restitution = 1.0;
    def.style.max_stretch = 1.5;
    def.position = {-3.0, 3.0, 0.0};
    def.velocity = {5.0, -5.0, 0.0};
    const BodyId body = valueOf(world.addBody(def));
    const Vec3 tail_before = -principalAxis(world.pose(body).orientation);
    EXPECT_GT(tail_before.y, 0.7);
    while (world.phase(body).motion.index() != 1) {
        world.step(0.01);
    }
    const Phase impact = world.phase(body);
    EXPECT_NEAR(impact.get<Impact>().turn_angle, M_PI / 2, 1e-9);
    const auto tailAt = [&](double t) { return -principalAxis(poseAt(impact, *def.shape, t).orientation); };
    EXPECT_LT(glm::length(tailAt(impact.start) - tail_before), 1e-9);
    const double middle = impact.start + impact.get<Impact>().curve.t_in;
    EXPECT_LT(glm::length(tailAt(middle) - Vec3(0, 1, 0)), 1e-9) << "half of the turn at the deepest squash";
    EXPECT_LT(glm::length(tailAt(impact.end) - glm::normalize(Vec3(1, 1, 0))), 1e-9);
}

TEST(Impact, SlowTouchWhilePartingFallsBackAlongItsWay) {
    // A long cylinder in a low slanting hop turns into the floor as it rises: it goes back upright, it does not flip
    // over.
    World world = worldWithFloor();
    BodyDef def;
    def.shape = valueOf(Shape::cylinder(0.15, 2.0));
    def.style.max_stretch = 1.2;
    def.position = {0.0, 1.6, 0.0};
    def.velocity = {1.5, 0.6, 0.0};
    const BodyId body = valueOf(world.addBody(def));
    for (int k = 0; k < 600; ++k) {
        world.step(1.0 / 60.0);
    }
    EXPECT_EQ(nameOf(world.phase(body)), "rest");
    EXPECT_NEAR(std::fabs(principalAxis(world.pose(body).orientation).y), 1.0, 1e-9) << "upright";
}

TEST(Rest, SlopesThatCanHoldDoAndSteepOnesDoNot) {
    for (const double degrees : {0.0, 20.0, 34.0, 36.0, 60.0, 90.0, 180.0}) {
        const double a = degrees * M_PI / 180.0;
        World world = worldWith();
        (void)valueOf(world.addObstacle(ObstacleDef::plane({std::sin(a), std::cos(a), 0.0}, 0.0)));
        BodyDef def;
        def.shape = valueOf(Shape::sphere(0.5));
        def.position = 0.6 * Vec3(std::sin(a), std::cos(a), 0.0);
        const BodyId body = valueOf(world.addBody(def));
        for (int k = 0; k < 600; ++k) {
            world.step(1.0 / 60.0);
        }
        EXPECT_EQ(nameOf(world.phase(body)) == "rest", degrees < 35.0) << degrees;
        if (degrees < 35.0) {
            const Vec3 axis = principalAxis(world.pose(body).orientation);
            EXPECT_LT(angleBetweenAxes(axis, {std::sin(a), std::cos(a), 0.0}), 1e-9) << "final axis along n";
        }
    }
}

TEST(Rest, IsExactlyStillAndRidesAMovingFloor) {
    World world = worldWith();
    ObstacleDef lift = ObstacleDef::plane({0, 1, 0}, 0.0);
    const ObstacleId floor = valueOf(world.addObstacle(lift));
    BodyDef def;
    def.shape = valueOf(Shape::box(Vec3(1.0)));
    def.position = {0.0, 0.5, 0.0};
    const BodyId body = valueOf(world.addBody(def));
    world.step(0.1);
    ASSERT_EQ(nameOf(world.phase(body)), "rest");
    const Pose still = world.pose(body);
    world.step(1000.0);
    EXPECT_EQ(world.pose(body).position, still.position);
    EXPECT_EQ(world.pose(body).orientation, still.orientation);
    ASSERT_TRUE(world.setObstacleMotion(floor, {1.0, 0.5, 0.0}, Vec3(0.0)).ok());
    world.step(2.0);
    EXPECT_EQ(nameOf(world.phase(body)), "rest");
    EXPECT_LT(glm::length(world.pose(body).position - (still.position + Vec3(2.0, 1.0, 0.0))), 1e-9);
    EXPECT_LT(glm::length(world.velocity(body) - Vec3(1.0, 0.5, 0.0)), 1e-12);
    ASSERT_TRUE(world.setObstacleMotion(floor, {0.0, -3.0, 0.0}, Vec3(0.0)).ok());
    EXPECT_EQ(nameOf(world.phase(body)), "flight") << "the floor drops away";
    world.step(0.0);
    ASSERT_FALSE(world.events().empty());
    EXPECT_EQ(world.events()[0].type, EventType::Wake);
}

TEST(Impact, MovingFloorLiftsAndThrows) {
    // A floor that rises at 2 m/s under a body at rest in the air, r = 1: it leaves at 4 m/s.
    World world = worldWith({0, 0, 0});
    ObstacleDef floor = ObstacleDef::plane({0, 1, 0}, 0.0);
    floor.velocity = {0.0, 2.0, 0.0};
    (void)valueOf(world.addObstacle(floor));
    BodyDef def;
    def.shape = valueOf(Shape::sphere(0.5));
    def.style.restitution = 1.0;
    def.position = {0.0, 1.5, 0.0};
    const BodyId body = valueOf(world.addBody(def));
    world.step(5.0);
    EXPECT_LT(glm::length(world.velocity(body) - Vec3(0.0, 4.0, 0.0)), 1e-9);
}

} // namespace
} // namespace elastoon
