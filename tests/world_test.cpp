// The world: ids, changes between steps, refusals, frame-rate independence, degenerate numbers, determinism.
#include "elastoon/world.h"

#include "elastoon/assert.h"
#include "test_support.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace elastoon {
namespace {

BodyDef ballAt(const Vec3& position, const Vec3& velocity = Vec3(0.0)) {
    static const ShapePtr ball = valueOf(Shape::sphere(0.5));
    BodyDef def;
    def.shape = ball;
    def.position = position;
    def.velocity = velocity;
    return def;
}

BodyDef longSoftCylinder() {
    static const ShapePtr cylinder = valueOf(Shape::cylinder(0.25, 3.0));
    BodyDef def;
    def.shape = cylinder;
    def.style.restitution = 0.7;
    def.style.max_stretch = 2.0;
    def.style.min_squash = 0.2;
    def.position = {0.0, 5.0, 0.0};
    def.velocity = {3.0, 2.0, 1.0};
    return def;
}

/// Positions at whole seconds, stepping by the given rule.
std::vector<Vec3> wholeSeconds(const BodyDef& def, int seconds, const std::function<double(double)>& stepAfter) {
    World world = worldWithFloor();
    const BodyId body = valueOf(world.addBody(def));
    std::vector<Vec3> positions;
    for (int second = 1; second <= seconds; ++second) {
        while (world.time() < second - 1e-9) {
            world.step(std::min(stepAfter(world.time()), second - world.time()));
        }
        positions.push_back(world.pose(body).position);
    }
    return positions;
}

TEST(World, PositionsDoNotDependOnTheStep) {
    for (const BodyDef& def : {ballAt({0, 10, 0}), ballAt({0, 6, 0}, {3, 1, 0}), longSoftCylinder()}) {
        const auto reference = wholeSeconds(def, 10, [](double) { return 1.0 / 60.0; });
        Random random(19);
        const std::function<double(double)> rules[] = {[](double) { return 1.0 / 24.0; },
                                                       [](double) { return 1.0 / 30.0; },
                                                       [](double) { return 1.0 / 144.0; },
                                                       [](double) { return 1.0 / 1000.0; },
                                                       [&](double) { return random.uniform(1e-4, 0.3); },
                                                       [](double) { return 10.0; }};
        for (const auto& rule : rules) {
            const auto positions = wholeSeconds(def, 10, rule);
            for (std::size_t i = 0; i < reference.size(); ++i) {
                EXPECT_LT(glm::length(positions[i] - reference[i]), 1e-6 * def.shape->length()) << i;
            }
        }
    }
}

TEST(World, OneStepOfTenSecondsIsTheSameAsMany) {
    World one = worldWithFloor();
    World many = worldWithFloor();
    const BodyId a = valueOf(one.addBody(longSoftCylinder()));
    const BodyId b = valueOf(many.addBody(longSoftCylinder()));
    one.step(10.0);
    std::size_t events = 0;
    for (int i = 0; i < 600; ++i) {
        many.step(1.0 / 60.0);
        events += many.events().size();
    }
    EXPECT_EQ(one.events().size(), events);
    EXPECT_LT(glm::length(one.pose(a).position - many.pose(b).position), 1e-6 * 3.0);
}

TEST(World, IdsOfRemovedObjectsStayInvalid) {
    World world = worldWithFloor();
    const BodyId first = valueOf(world.addBody(ballAt({0, 3, 0})));
    EXPECT_TRUE(world.contains(first));
    EXPECT_TRUE(world.removeBody(first));
    EXPECT_FALSE(world.contains(first));
    EXPECT_FALSE(world.removeBody(first));
    const BodyId second = valueOf(world.addBody(ballAt({0, 4, 0})));
    EXPECT_EQ(first.slot, second.slot) << "the slot is used again";
    EXPECT_FALSE(world.contains(first));
    EXPECT_FALSE(world.contains(BodyId{}));
    EXPECT_FALSE(world.contains(BodyId{77, 1}));
    EXPECT_EQ(world.setVelocity(first, Vec3(0.0)).error().where, "id");
    EXPECT_EQ(world.bodies(), std::vector<BodyId>{second});
}

TEST(World, UserDataStaysWithItsObject) {
    World world = worldWith();
    ObstacleDef plane = ObstacleDef::plane({0, 1, 0}, 0);
    EXPECT_EQ(world.userData(valueOf(world.addObstacle(plane))), 0U);
    plane.user_data = 0xfedcba9876543210ULL;
    const ObstacleId removed = valueOf(world.addObstacle(plane));
    EXPECT_EQ(world.userData(removed), 0xfedcba9876543210ULL);
    world.removeObstacle(removed);
    plane.user_data = 5;
    const ObstacleId obstacle = valueOf(world.addObstacle(plane));
    EXPECT_EQ(obstacle.slot, removed.slot);
    BodyDef ball = ballAt({0, 3, 0});
    ball.user_data = 7;
    const BodyId body = valueOf(world.addBody(ball));
    world.step(0.5);
    ASSERT_TRUE(world.setObstaclePose(obstacle, {0, -1, 0}, kNoRotation).ok());
    World other = worldWith();
    ASSERT_TRUE(other.restore(world.snapshot({.include_shapes = true})).ok());
    for (const World* each : {&world, &other}) {
        EXPECT_EQ(each->userData(obstacle), 5U);
        EXPECT_EQ(each->userData(body), 7U);
    }
}

TEST(World, ObjectsComeAndGoBetweenSteps) {
    World world = worldWith();
    const ObstacleId floor = valueOf(world.addObstacle(ObstacleDef::plane({0, 1, 0}, 0.0)));
    Random random(20);
    std::vector<BodyId> bodies;
    for (int i = 0; i < 600; ++i) {
        if (random.below(3) == 0) {
            bodies.push_back(valueOf(world.addBody(ballAt({0.0, random.uniform(1.0, 5.0), 0.0}, random.inBox(5.0)))));
        }
        if (!bodies.empty() && random.below(5) == 0) {
            const int index = random.below(static_cast<int>(bodies.size()));
            EXPECT_TRUE(world.removeBody(bodies[static_cast<std::size_t>(index)]));
            bodies.erase(bodies.begin() + index);
        }
        world.step(1.0 / 60.0);
        for (const BodyId id : bodies) {
            ASSERT_TRUE(std::isfinite(world.pose(id).position.y));
            EXPECT_GT(lowestPoint(*world.shape(id), world.pose(id)), -1e-9);
        }
    }
    EXPECT_TRUE(world.removeObstacle(floor));
    world.step(2.0);
    for (const BodyId id : bodies) {
        EXPECT_LT(world.pose(id).position.y, 3.0);
        EXPECT_EQ(nameOf(world.phase(id)), "flight") << "nothing holds a body any more";
    }
}

TEST(World, UnrelatedObjectsDoNotChangeABody) {
    World alone = worldWithFloor();
    World crowded = worldWithFloor();
    (void)valueOf(crowded.addBody(ballAt({50, 3, 0}, {1, 0, 0})));
    const BodyId a = valueOf(alone.addBody(longSoftCylinder()));
    const BodyId b = valueOf(crowded.addBody(longSoftCylinder()));
    (void)valueOf(crowded.addObstacle(ObstacleDef::plane({0, -1, 0}, -1000.0)));
    for (int i = 0; i < 300; ++i) {
        alone.step(1.0 / 60.0);
        crowded.step(1.0 / 60.0);
        ASSERT_EQ(alone.pose(a).position, crowded.pose(b).position) << i;
    }
}

TEST(World, ThreadsDoNotChangeTheHash) {
    const auto run = [](const ParallelFor& parallel_for) {
        World world = valueOf(World::create({.gravity = {0, -9.81, 0}, .parallel_for = parallel_for}));
        (void)valueOf(world.addObstacle(ObstacleDef::plane({0.1, 1, 0}, 0.0)));
        Random random(21);
        for (int i = 0; i < 100; ++i) {
            (void)valueOf(world.addBody(ballAt({0, random.uniform(3, 9), 0}, random.inBox(3.0))));
        }
        std::uint64_t hash = 0;
        for (int i = 0; i < 200; ++i) {
            world.step(1.0 / 60.0);
            for (const Event& event : world.events()) {
                hash = hash * 31 + event.body.slot;
            }
        }
        return std::pair(world.stateHash(), hash);
    };
    // A cut into uneven parts that run backwards is as bad as any thread order.
    const ParallelFor backwards = [](std::size_t count, const std::function<void(std::size_t, std::size_t)>& body) {
        for (std::size_t end = count; end > 0;) {
            const std::size_t begin = end > 7 ? end - 7 : 0;
            body(begin, end);
            end = begin;
        }
    };
    EXPECT_EQ(run({}), run(backwards));
}

/// A clock that goes on by one at each look: every part is measured once for each time it runs.
TEST(World, ProfileNamesThePartsOfTheStep) {
    double looks = 0.0;
    const auto make = [](const std::function<double()>& clock) {
        World world = valueOf(World::create({.gravity = {0, -9.81, 0}, .parallel_for = {}, .clock = clock}));
        (void)valueOf(world.addObstacle(ObstacleDef::plane({0, 1, 0}, 0.0)));
        ObstacleDef lift;
        lift.shape = valueOf(Shape::box({1.0, 0.1, 1.0}));
        lift.position = {5, 1, 0};
        lift.path = {{0.05, {5, 2, 0}, kNoRotation}, {1.0, {5, 1, 0}, kNoRotation}};
        (void)valueOf(world.addObstacle(lift));
        (void)valueOf(world.addBody(ballAt({0, 3, 0})));
        return world;
    };
    World world = make([&] { return looks += 1.0; });
    EXPECT_EQ(world.profile().advance, 0.0);
    world.step(0.1);
    (void)world.matrices();
    (void)world.matrices();
    // A key of the path lies within the step: two goes.
    EXPECT_EQ(world.profile().prepare, 2.0);
    EXPECT_EQ(world.profile().advance, 2.0);
    EXPECT_EQ(world.profile().follow_paths, 2.0);
    EXPECT_EQ(world.profile().sort_events, 1.0);
    EXPECT_EQ(world.profile().matrices, 2.0);
    EXPECT_EQ(world.profile().advanced, 2U);
    World plain = make({});
    plain.step(0.1);
    EXPECT_EQ(plain.profile().advance, 0.0);
    EXPECT_EQ(plain.stateHash(), world.stateHash());
}

TEST(World, UserChangesTakeEffectAtOnce) {
    World world = worldWithFloor();
    const BodyId body = valueOf(world.addBody(ballAt({0, 0.5, 0})));
    world.step(0.1);
    ASSERT_EQ(nameOf(world.phase(body)), "rest");
    ASSERT_TRUE(world.setVelocity(body, {0, 6, 0}).ok());
    EXPECT_EQ(world.velocity(body), Vec3(0, 6, 0));
    world.step(0.3);
    EXPECT_GT(world.pose(body).position.y, 1.5);
    ASSERT_TRUE(world.setPosition(body, {4, 7, 0}).ok());
    EXPECT_EQ(world.pose(body).position, Vec3(4, 7, 0));
    EXPECT_FALSE(world.setPosition(body, {0, -3, 0}).ok()) << "inside the floor";
    EXPECT_EQ(world.pose(body).position, Vec3(4, 7, 0));
    Style style;
    style.max_stretch = 1.0;
    ASSERT_TRUE(world.setStyle(body, style).ok());
    EXPECT_EQ(world.pose(body).stretch, 1.0);
    ASSERT_TRUE(world.setGravity({0, 9.81, 0}).ok());
    world.step(3.0);
    EXPECT_GT(world.pose(body).position.y, 20.0);
}

TEST(World, RefusesBadInputAtTheDoor) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    World world = worldWithFloor();
    const auto refused = [&](auto&& change, const char* where) {
        BodyDef def = ballAt({0, 5, 0});
        change(def);
        const auto result = world.addBody(def);
        ASSERT_FALSE(result.ok()) << where;
        EXPECT_EQ(result.error().where, where);
        EXPECT_FALSE(result.error().message.empty());
    };
    refused([](BodyDef& d) { d.shape = nullptr; }, "shape");
    refused([&](BodyDef& d) { d.position.x = nan; }, "position");
    refused([&](BodyDef& d) { d.velocity.z = inf; }, "velocity");
    refused([&](BodyDef& d) { d.rotation = Quat(0, 0, 0, 0); }, "rotation");
    refused([&](BodyDef& d) { d.rotation.w = nan; }, "rotation");
    refused([&](BodyDef& d) { d.style.restitution = -0.1; }, "style.restitution");
    refused([&](BodyDef& d) { d.style.max_stretch = 0.9; }, "style.max_stretch");
    refused([&](BodyDef& d) { d.style.min_squash = 0.0; }, "style.min_squash");
    refused([&](BodyDef& d) { d.style.stretch_rate = nan; }, "style.stretch_rate");
    refused([&](BodyDef& d) { d.style.rest_speed = -2.0; }, "style.rest_speed");
    refused([](BodyDef& d) { d.position.y = 0.3; }, "position");
    EXPECT_TRUE(world.bodies().empty());
    EXPECT_FALSE(world.addObstacle(ObstacleDef::plane({0, 0, 0}, 1.0)).ok());
    EXPECT_FALSE(world.addObstacle(ObstacleDef::plane({0, 1, nan}, 1.0)).ok());
    EXPECT_FALSE(World::create({.gravity = {0, nan, 0}, .parallel_for = {}}).ok());
    EXPECT_FALSE(world.setGravity({inf, 0, 0}).ok());
    EXPECT_TRUE(world.overlapOf(ballAt({0, 0.3, 0})).has_value());
    EXPECT_NEAR(world.overlapOf(ballAt({0, 0.3, 0}))->depth, 0.2, 1e-12);
    EXPECT_FALSE(world.overlapOf(ballAt({0, 0.5, 0})).has_value());
}

int assertions = 0;

TEST(World, BadStepsAssertAndDoNothing) {
    World world = worldWithFloor();
    const AssertHandler before = setAssertHandler([](const char*, const char*, const char*, int) { ++assertions; });
    assertions = 0;
    for (const double dt :
         {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e9}) {
        world.step(dt);
    }
    setAssertHandler(before);
    EXPECT_EQ(assertions, 4);
    EXPECT_EQ(world.time(), 0.0);
}

TEST(World, DegenerateNumbersDoTheSensibleThing) {
    for (const Vec3& gravity : {Vec3(0, -9.81, 0), Vec3(0.0), Vec3(0, -1e5, 0), Vec3(0, -1e-9, 0)}) {
        for (const double speed : {0.0, 1e-12, 3.0, 1e5}) {
            for (int variant = 0; variant < 6; ++variant) {
                BodyDef def = ballAt({0, 2, 0}, {0.3 * speed, -speed, 0});
                def.style.squash_law = variant % 2 == 0 ? SquashLaw::Bounded : SquashLaw::Paper;
                def.style.restitution = variant < 2 ? 0.0 : 1.0;
                if (variant >= 2) {
                    def.style.stretch_rate = variant < 4 ? 0.0 : 0.1;
                    def.style.max_stretch = def.style.min_squash = 1.0;
                }
                World world = worldWithFloor(gravity);
                const BodyId body = valueOf(world.addBody(def));
                for (const double dt : {0.0, 1e-9, 0.1, 1.0, 30.0}) {
                    world.step(dt);
                    const Pose pose = world.pose(body);
                    ASSERT_TRUE(std::isfinite(glm::length(pose.position) + pose.stretch));
                    EXPECT_GT(lowestPoint(*def.shape, pose), -1e-9 * std::max(1.0, std::fabs(pose.position.y)));
                    EXPECT_GT(pose.stretch, 0.0);
                }
            }
        }
    }
}

TEST(World, ZeroStepChangesNothing) {
    World world = worldWithFloor();
    (void)valueOf(world.addBody(ballAt({0, 2, 0})));
    world.step(0.3);
    const std::uint64_t hash = world.stateHash();
    world.step(0.0);
    EXPECT_EQ(world.stateHash(), hash);
    EXPECT_TRUE(world.events().empty());
}

TEST(World, HugeStepEnds) {
    World world = worldWithFloor();
    BodyDef def = ballAt({0, 2, 0}, {1, 0, 0});
    const BodyId soft = valueOf(world.addBody(def));
    def.style.restitution = 1.0;
    const BodyId eternal = valueOf(world.addBody(def));
    world.step(1e6);
    EXPECT_EQ(nameOf(world.phase(soft)), "rest");
    EXPECT_GT(lowestPoint(*def.shape, world.pose(eternal)), -1e-9);
    EXPECT_LT(world.pose(eternal).position.y, 2.6);
}

TEST(World, RestitutionOneKeepsItsHeight) {
    World world = worldWithFloor();
    BodyDef def = ballAt({0, 5, 0});
    def.style.restitution = 1.0;
    const BodyId body = valueOf(world.addBody(def));
    double highest = 0.0;
    for (int i = 0; i < 60 * 60; ++i) {
        world.step(1.0 / 60.0);
        highest = i > 60 * 50 ? std::max(highest, world.pose(body).position.y) : 0.0;
    }
    EXPECT_NEAR(highest, 5.0, 0.02);
}

TEST(World, EventsAreInOrderOfTime) {
    World world = worldWithFloor();
    Random random(22);
    for (int i = 0; i < 50; ++i) {
        (void)valueOf(world.addBody(ballAt({0, random.uniform(1, 9), 0}, random.inBox(4.0))));
    }
    world.step(5.0);
    EXPECT_GT(world.events().size(), 100U);
    EXPECT_TRUE(std::is_sorted(world.events().begin(), world.events().end(),
                               [](const Event& a, const Event& b) { return a.time < b.time; }));
}

TEST(World, WhatComesIntoTheWayOfAFarBodyIsMet) {
    // A body far from everything is not searched for; a change of the surroundings makes it be again.
    World world = worldWithFloor();
    BodyDef def;
    def.shape = valueOf(Shape::sphere(0.5));
    def.position = {0, 500, 0};
    const BodyId body = valueOf(world.addBody(def));
    const auto steps = [&](int count) {
        int impacts = 0;
        for (int i = 0; i < count; ++i) {
            world.step(1.0 / 60.0);
            impacts += static_cast<int>(std::count_if(world.events().begin(), world.events().end(),
                                                      [](const Event& e) { return e.type == EventType::Impact; }));
        }
        return impacts;
    };
    EXPECT_EQ(steps(60), 0);
    const double y = world.pose(body).position.y;
    const ObstacleId plate = valueOf(world.addObstacle(ObstacleDef::plane({0, 1, 0}, y - 1.5)));
    EXPECT_EQ(steps(6), 1) << "the plane that was put under it";
    ASSERT_TRUE(world.removeObstacle(plate));
    ObstacleDef box;
    box.shape = valueOf(Shape::box({3, 1, 3}));
    EXPECT_EQ(steps(60), 0);
    box.position = {0, world.pose(body).position.y - 3.0, 0};
    (void)valueOf(world.addObstacle(box));
    EXPECT_EQ(steps(60), 1) << "and the box";
}

} // namespace
} // namespace elastoon
