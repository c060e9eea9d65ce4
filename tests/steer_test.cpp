// Steered impacts: the body leaves with what it was told, nothing jumps, and nothing is entered.
#include "oracle.h"
#include "test_support.h"

#include <algorithm>

namespace elastoon {
namespace {

constexpr double kStep = 1.0 / 120.0;

Style springy(Random& random) {
    Style style;
    style.restitution = random.uniform(0.3, 1.0);
    style.max_stretch = random.uniform(1.0, 2.0);
    style.min_squash = random.uniform(0.4, 1.0);
    style.squash_rate = random.uniform(0.5, 3.0);
    return style;
}

double turnBetween(const Quat& a, const Quat& b) {
    const Quat turn = glm::conjugate(a) * b;
    return 2.0 * std::sqrt(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);
}

struct Room {
    Scene scene;
    StagedScene staged;
    Timeline timeline;
};

Room roomWith(Random& random) {
    Scene scene;
    scene.gravity = {0, random.below(2) == 0 ? -4.0 : 0.0, 0};
    SceneObstacle floor;
    floor.name = "floor";
    floor.def = ObstacleDef::plane({0, 1, 0}, 0);
    scene.obstacles.push_back(floor);
    SceneObstacle wall;
    wall.name = "wall";
    wall.def = ObstacleDef::plane({-1, 0, 0}, -2.0);
    scene.obstacles.push_back(wall);
    SceneBody ball;
    ball.name = "ball";
    ball.def.shape = valueOf(random.below(2) == 0 ? Shape::sphere(0.4, 4) : Shape::cylinder(0.3, 0.9, 12));
    ball.def.style = springy(random);
    ball.def.position = {random.uniform(-1.0, 1.0), random.uniform(1.5, 3.0), 0};
    ball.def.velocity = {random.uniform(-4.0, 4.0), random.uniform(-12.0, -5.0), 0};
    scene.bodies.push_back(ball);
    StagedScene staged = valueOf(stage(scene));
    return {std::move(scene), std::move(staged), {}};
}

TEST(Steer, LeavesAsToldWithoutAJump) {
    Random random(20021);
    int steered = 0;
    for (int round = 0; round < 300; ++round) {
        Room room = roomWith(random);
        World& world = room.staged.world;
        const BodyId id = room.staged.bodies[0];
        room.timeline.begin(world);
        const int late = random.below(6); // steps into the impact
        int in_impact = 0;
        const double angle = random.uniform(-1.2, 1.2);
        const double speed = random.uniform(2.0, 12.0);
        Vec3 told(0.0);
        for (int i = 0; i < 240; ++i) {
            world.step(kStep);
            room.timeline.capture(world);
            if (told != Vec3(0.0)) {
                const auto events = world.events();
                const auto released = std::find_if(events.begin(), events.end(),
                                                   [](const Event& e) { return e.type == EventType::Release; });
                if (released != events.end()) {
                    const bool alone = world.phase(id).is<Flight>();
                    const Vec3 since = world.gravity() * (world.time() - released->time);
                    EXPECT_TRUE(!alone || glm::length(world.velocity(id) - since - told) < 1e-9) << round;
                    break;
                }
                continue;
            }
            const Phase phase = world.phase(id);
            const auto* impact = phase.as<Impact>();
            if (impact == nullptr || impact->surface.normal.y < 0.5 || in_impact++ < late) {
                continue;
            }
            told = speed * Vec3(angle / 1.6, 1.0 - 0.4 * std::fabs(angle), 0.0);
            const Pose before = world.pose(id);
            ASSERT_TRUE(world.steerImpact(id, told).ok());
            const Pose after = world.pose(id);
            EXPECT_LT(glm::length(before.position - after.position), 1e-9);
            EXPECT_LT(std::fabs(before.stretch - after.stretch), 1e-12);
            EXPECT_LT(turnBetween(before.orientation, after.orientation), 1e-9);
            ++steered;
        }
        const OracleReport report = inspect(room.scene, room.staged, room.timeline, 240.0);
        EXPECT_TRUE(report.withinBounds()) << round << ": depth " << report.depth.value << " gap " << report.gap.value
                                           << " jump " << report.jump.value << " at " << report.jump.time;
    }
    EXPECT_GT(steered, 150); // a seldom case would prove little
}

TEST(Steer, TheAxisArrivesAtTheNewWay) {
    World world = valueOf(World::create({.gravity = Vec3(0.0), .parallel_for = {}}));
    (void)valueOf(world.addObstacle(ObstacleDef::plane({0, 1, 0}, 0)));
    BodyDef ball;
    ball.shape = valueOf(Shape::sphere(0.5, 4));
    ball.style.restitution = 1.0;
    ball.position = {0, 2, 0};
    ball.velocity = {3, -8, 0};
    const BodyId id = valueOf(world.addBody(ball));
    while (!world.phase(id).is<Impact>()) {
        world.step(kStep);
    }
    const Vec3 told(-5, 7, 0);
    ASSERT_TRUE(world.steerImpact(id, told).ok());
    const Phase phase = world.phase(id);
    const Pose last = poseAt(phase, *world.shape(id), phase.end);
    EXPECT_LT(glm::length(glm::cross(last.orientation * Vec3(1, 0, 0), glm::normalize(told))), 1e-9);
    EXPECT_NEAR(last.stretch, stretchAtSpeed(ball.style, glm::length(told)), 1e-12);
}

TEST(Steer, ASurfaceThatChangesItsVelocityIsAllowedFor) {
    World world = valueOf(World::create({.gravity = Vec3(0.0), .parallel_for = {}}));
    ObstacleDef paddle;
    paddle.shape = valueOf(Shape::box({4, 1, 2}));
    const ObstacleId obstacle = valueOf(world.addObstacle(paddle));
    BodyDef ball;
    ball.shape = valueOf(Shape::sphere(0.5, 4));
    ball.position = {0, 2, 0};
    ball.velocity = {0, -8, 0};
    const BodyId id = valueOf(world.addBody(ball));
    while (!world.phase(id).is<Impact>()) {
        world.step(kStep);
    }
    const Vec3 told(2, 7, 0);
    double speed = 10.0;
    while (world.phase(id).is<Impact>()) {
        ASSERT_TRUE(world.setObstacleMotion(obstacle, {speed, 0, 0}, Vec3(0.0)).ok());
        ASSERT_TRUE(world.steerImpact(id, told).ok());
        speed = -speed;
        world.step(kStep);
    }
    EXPECT_LT(glm::length(world.velocity(id) - told), 1e-9);
}

TEST(Steer, TellsWhatItRefuses) {
    World world = valueOf(World::create());
    (void)valueOf(world.addObstacle(ObstacleDef::plane({0, 1, 0}, 0)));
    BodyDef ball;
    ball.shape = valueOf(Shape::sphere(0.5, 4));
    ball.position = {0, 2, 0};
    const BodyId id = valueOf(world.addBody(ball));
    EXPECT_EQ(world.steerImpact(id, {0, 1, 0}).error().text(), "id: the body must be in an impact, is in a flight");
    EXPECT_FALSE(world.steerImpact({}, {0, 1, 0}).ok());
    while (!world.phase(id).is<Impact>()) {
        world.step(kStep);
    }
    const auto hash = world.stateHash();
    EXPECT_EQ(world.steerImpact(id, {3, -1, 0}).error().text(),
              "velocity: must part from the surface that the body is in contact with");
    EXPECT_FALSE(world.steerImpact(id, {0, std::numeric_limits<double>::quiet_NaN(), 0}).ok());
    EXPECT_EQ(world.stateHash(), hash);
}

} // namespace
} // namespace elastoon
