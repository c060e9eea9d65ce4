// Obstacles on paths, teleported, sent somewhere; and what a body is told of the time ahead.
#include "contact.h"
#include "path.h"
#include "test_support.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace elastoon {
namespace {

Quat turnedBy(const Vec3& axis, double angle) {
    const Vec3 v = axis * std::sin(0.5 * angle);
    return {std::cos(0.5 * angle), v.x, v.y, v.z};
}

TEST(Path, IsAtItsKeysAndBetweenThem) {
    ObstacleDef def;
    def.position = {1, 0, 0};
    def.path = {{1.0, {1, 2, 0}, kNoRotation}, {3.0, {1, 2, 4}, turnedBy({0, 1, 0}, 1.0)}};
    const auto at = [&](double t) {
        const MovingFrame frame = frameAt(def, 10.0, t);
        return Pose{frame.originAt(t), frame.orientationAt(t), 1.0};
    };
    EXPECT_LT(glm::length(at(10.5).position - Vec3(1, 1, 0)), 1e-12);
    EXPECT_LT(glm::length(at(11.0).position - Vec3(1, 2, 0)), 1e-12);
    EXPECT_LT(glm::length(at(12.0).position - Vec3(1, 2, 2)), 1e-12);
    EXPECT_LT(angleBetween(at(12.0).orientation, turnedBy({0, 1, 0}, 0.5)), 1e-12);
    EXPECT_LT(glm::length(at(99.0).position - Vec3(1, 2, 4)), 1e-12) << "it stops at the last";
    def.path_repeats = true;
    EXPECT_LT(glm::length(at(13.5).position - Vec3(1, 1, 0)), 1e-12) << "and starts again";
    EXPECT_LT(glm::length(at(10.0 + 3.0 * 1000.0 + 0.5).position - Vec3(1, 1, 0)), 1e-9);
}

TEST(Path, RepeatsForEverAtAnyTime) {
    Random random(61);
    for (int i = 0; i < 2000; ++i) {
        Path path;
        path.added = random.uniform(0.0, 10.0);
        path.repeats = true;
        path.keys = {{random.uniform(0.01, 1.0), {1, 0, 0}, kNoRotation}, {random.uniform(1.1, 3.0), {}, kNoRotation}};
        double t = path.added;
        for (int k = 0; k < 50; ++k) {
            const double next = nextChange(path, t);
            ASSERT_GT(next, t);
            ASSERT_LT(next, t + 3.1);
            t = next;
        }
    }
}

TEST(Path, ALiftCarriesABodyUpAndDownWhateverTheStep) {
    double heights[3] = {};
    int n = 0;
    for (const double fps : {24.0, 60.0, 144.0}) {
        World world = worldWith();
        ObstacleDef lift;
        lift.shape = valueOf(Shape::box({4, 1, 4}));
        lift.path = {{4.0, {0, 0, 0}, kNoRotation}, {6.0, {0, 3, 0}, kNoRotation}, {7.0, {0, 3, 0}, kNoRotation}};
        (void)valueOf(world.addObstacle(lift));
        BodyDef def;
        def.shape = valueOf(Shape::sphere(0.5));
        def.style.restitution = 0.3;
        def.position = {0, 1.5, 0};
        const BodyId body = valueOf(world.addBody(def));
        for (int i = 0; i < static_cast<int>(6.5 * fps); ++i) {
            world.step(1.0 / fps);
        }
        heights[n++] = world.pose(body).position.y;
    }
    EXPECT_NEAR(heights[0], heights[1], 1e-6);
    EXPECT_NEAR(heights[2], heights[1], 1e-6);
    EXPECT_GT(heights[1], 3.9) << "it came up with the lift";
}

struct UnderAPlate {
    World world;
    BodyId body;
    ObstacleId press;
};

/// A ball at rest on the floor, and a plate 3 m up.
UnderAPlate ballUnderAPlate() {
    World world = worldWithFloor();
    BodyDef def;
    def.shape = valueOf(Shape::sphere(0.5));
    def.style.restitution = 0.3;
    def.position = {0, 0.8, 0};
    const BodyId body = valueOf(world.addBody(def));
    ObstacleDef plate;
    plate.shape = valueOf(Shape::box({3, 0.2, 3}));
    plate.position = {0, 3, 0};
    const ObstacleId press = valueOf(world.addObstacle(plate));
    for (int i = 0; i < 240; ++i) {
        world.step(1.0 / 60.0);
    }
    return {std::move(world), body, press};
}

TEST(Path, APressFlattensAndLetsGo) {
    auto [world, body, press] = ballUnderAPlate();
    ASSERT_EQ(nameOf(world.phase(body)), "rest");
    ASSERT_TRUE(world.moveObstacle(press, {0, 0.5, 0}, kNoRotation, 1.0).ok());
    int squeezes = 0;
    double flattest = 1.0;
    for (int i = 0; i < 90; ++i) {
        world.step(1.0 / 60.0);
        squeezes += static_cast<int>(std::count_if(world.events().begin(), world.events().end(),
                                                   [](const Event& e) { return e.type == EventType::Squeeze; }));
        const Pose pose = world.pose(body);
        flattest = std::min(flattest, pose.stretch);
        EXPECT_GT(lowestPoint(*world.shape(body), pose), -1e-9);
    }
    EXPECT_EQ(squeezes, 1);
    EXPECT_NEAR(flattest, 0.4, 1e-6) << "what is left between floor and plate";
    ASSERT_TRUE(world.removeObstacle(press));
    double last = world.pose(body).stretch;
    for (int i = 0; i < 60; ++i) {
        world.step(1.0 / 120.0);
        const double now = world.pose(body).stretch;
        EXPECT_LT(std::fabs(now - last), 0.1) << "it comes back smoothly";
        last = now;
    }
    EXPECT_EQ(world.pose(body).stretch, 1.0);
    EXPECT_EQ(nameOf(world.phase(body)), "rest");
}

TEST(Path, APressThatLeavesNoRoomEntersTheBodyAsItIs) {
    auto [world, body, press] = ballUnderAPlate();
    ASSERT_EQ(nameOf(world.phase(body)), "rest");
    ASSERT_TRUE(world.moveObstacle(press, {0, 0.0, 0}, kNoRotation, 1.0).ok());
    Pose last = world.pose(body);
    for (int i = 0; i < 480; ++i) {
        world.step(1.0 / 480.0);
        const Pose pose = world.pose(body);
        EXPECT_LT(std::fabs(pose.stretch - last.stretch), 0.02) << "at " << world.time() << " s";
        EXPECT_LT(glm::length(pose.position - last.position), 0.02) << "at " << world.time() << " s";
        last = pose;
    }
    EXPECT_GT(last.stretch, 0.04);
    EXPECT_LT(last.stretch, 0.06) << "a twentieth is left of it";
}

TEST(Path, TeleportsLeaveBodiesBehindAndPutThemOut) {
    World world = worldWithFloor();
    ObstacleDef table;
    table.shape = valueOf(Shape::box({2, 1, 2}));
    table.position = {0, 0.5, 0};
    const ObstacleId id = valueOf(world.addObstacle(table));
    BodyDef def;
    def.shape = valueOf(Shape::sphere(0.5));
    def.style.restitution = 0.2;
    def.position = {0, 1.6, 0};
    const BodyId body = valueOf(world.addBody(def));
    const auto rest = [&] {
        for (int i = 0; i < 300; ++i) {
            world.step(1.0 / 60.0);
        }
        ASSERT_EQ(nameOf(world.phase(body)), "rest");
    };
    rest();
    EXPECT_NEAR(world.pose(body).position.y, 1.5, 1e-9);
    ASSERT_TRUE(world.setObstaclePose(id, {5, 0.5, 0}, kNoRotation).ok());
    rest();
    EXPECT_NEAR(world.pose(body).position.y, 0.5, 1e-9) << "it fell to the floor";
    ASSERT_TRUE(world.setObstaclePose(id, {0.9, 0.5, 0}, kNoRotation).ok());
    for (int i = 0; i < 300; ++i) {
        world.step(1.0 / 60.0);
    }
    const Vec3 p = world.pose(body).position;
    const bool out = p.x < 0.9 - 1.0 - 0.5 + 1e-5 || p.y > 1.5 - 1e-5;
    EXPECT_TRUE(out) << "the table came upon it: " << p.x << " " << p.y;
    EXPECT_FALSE(world.setObstaclePose(id, {std::nan(""), 0, 0}, kNoRotation).ok());
    EXPECT_FALSE(world.moveObstacle(id, {0, 0, 0}, kNoRotation, 0.0).ok());
    EXPECT_FALSE(world.moveObstacle(id, {1e9, 0, 0}, kNoRotation, 1e-3).ok());
}

TEST(Predict, IsWhatThenHappens) {
    Random random(62);
    for (int i = 0; i < 20; ++i) {
        World world = worldWithFloor();
        (void)valueOf(world.addObstacle(ObstacleDef::plane({-1, 0, 0}, -3.0)));
        ObstacleDef solid;
        solid.shape = valueOf(Shape::box({2, 1, 2}));
        solid.position = {0, 0.5, 0};
        if (i % 2 == 1) {
            solid.path = {{1.3, {1, 0.5, 0}, kNoRotation}, {2.0, {0, 0.5, 0}, kNoRotation}};
            solid.path_repeats = true;
        }
        (void)valueOf(world.addObstacle(solid));
        BodyDef def;
        def.shape = valueOf(Shape::sphere(0.4, 4));
        def.position = {random.uniform(-1, 1), 3.0, 0.0};
        def.velocity = random.inBox(3.0);
        const BodyId body = valueOf(world.addBody(def));
        const std::uint64_t before = world.stateHash();
        const Prediction ahead = world.predict(body, 2.5);
        EXPECT_EQ(world.stateHash(), before) << "the world stays as it is";
        ASSERT_FALSE(ahead.events.empty());
        std::vector<Event> events;
        for (int k = 0; k < 150; ++k) {
            world.step(1.0 / 60.0);
            events.insert(events.end(), world.events().begin(), world.events().end());
            const Pose pose = world.pose(body);
            const Pose predicted = ahead.poseAt(*def.shape, world.time());
            ASSERT_LT(glm::length(pose.position - predicted.position), 1e-4 * def.shape->length())
                << i << " at " << world.time();
        }
        ASSERT_EQ(events.size(), ahead.events.size());
        for (std::size_t k = 0; k < events.size(); ++k) {
            EXPECT_EQ(events[k].type, ahead.events[k].type);
            EXPECT_EQ(events[k].body, ahead.events[k].body);
            EXPECT_NEAR(events[k].time, ahead.events[k].time, 1e-5);
        }
    }
}

} // namespace
} // namespace elastoon
