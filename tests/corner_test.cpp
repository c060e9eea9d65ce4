// Bodies among several surfaces at once: corners, presses, what waits and what is dropped.
#include "closest_support.h"
#include "contact.h"
#include "test_support.h"
#include "witness_support.h"

#include <algorithm>
#include <cmath>

namespace elastoon {
namespace {

BodyDef ball(double restitution, const Vec3& position, const Vec3& velocity) {
    BodyDef def;
    def.shape = valueOf(Shape::sphere(0.5));
    def.style.restitution = restitution;
    def.position = position;
    def.velocity = velocity;
    return def;
}

std::vector<Event> run(World& world, double seconds, double fps = 60.0) {
    std::vector<Event> events;
    for (int i = 0; i < static_cast<int>(seconds * fps); ++i) {
        world.step(1.0 / fps);
        events.insert(events.end(), world.events().begin(), world.events().end());
    }
    return events;
}

int countOf(const std::vector<Event>& events, EventType type) {
    return static_cast<int>(
        std::count_if(events.begin(), events.end(), [&](const Event& e) { return e.type == type; }));
}

TEST(Corner, FloorThenWallWithNoFlightBetween) {
    World world = worldWithFloor({0, 0, 0});
    const ObstacleId wall = valueOf(world.addObstacle(ObstacleDef::plane({-1, 0, 0}, 0.0)));
    const BodyId body = valueOf(world.addBody(ball(1.0, {-2.2, 2.0, 0.0}, {6.0, -6.0, 0.0})));
    const auto events = run(world, 2.0);
    ASSERT_EQ(events.size(), 4U);
    EXPECT_EQ(events[1].type, EventType::Release);
    EXPECT_EQ(events[2].type, EventType::Impact);
    EXPECT_EQ(events[2].other, wall);
    EXPECT_EQ(events[1].time, events[2].time) << "the one that waited takes over at once";
    EXPECT_LT(glm::length(world.velocity(body) - Vec3(-6.0, 6.0, 0.0)), 1e-9) << "r = 1 goes back";
}

TEST(Corner, WhatIsNoLongerApproachedIsDropped) {
    World world = worldWithFloor({0, 0, 0});
    (void)valueOf(world.addObstacle(ObstacleDef::plane({-1, 0, 0}, 0.0)));
    // Its bulge on the floor touches the wall, which it flies along.
    const BodyId body = valueOf(world.addBody(ball(0.8, {-0.52, 3.0, 0.0}, {0.0, -8.0, 0.0})));
    bool waited = false;
    std::vector<Event> events;
    for (int i = 0; i < 120; ++i) {
        world.step(1.0 / 60.0);
        waited = waited || (!world.phase(body).clear_of.empty() && world.phase(body).is<Impact>());
        events.insert(events.end(), world.events().begin(), world.events().end());
    }
    EXPECT_TRUE(waited);
    EXPECT_EQ(countOf(events, EventType::Impact), 1);
    EXPECT_EQ(countOf(events, EventType::Release), 1);
}

TEST(Corner, BlendedGoesBackAlongItsWay) {
    const auto exitOf = [](double turn) {
        World world = worldWithFloor({0, 0, 0});
        (void)valueOf(world.addObstacle(ObstacleDef::plane({-1, 0, 0}, 0.0)));
        const double angle = -0.25 * M_PI + turn;
        BodyDef def = ball(1.0, {-3.0, 3.0, 0.0}, 8.0 * Vec3(std::cos(angle), std::sin(angle), 0.0));
        def.style.corner_rule = CornerRule::Blended;
        const BodyId body = valueOf(world.addBody(def));
        const auto events = run(world, 2.0);
        EXPECT_EQ(countOf(events, EventType::Impact), 1) << "both at once, turn " << turn;
        return glm::normalize(world.velocity(body));
    };
    const auto degreesBetween = [](const Vec3& a, const Vec3& b) {
        return 180.0 / M_PI * std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
    };
    const Vec3 back = exitOf(0.0);
    EXPECT_LT(degreesBetween(back, Vec3(-std::sqrt(0.5), std::sqrt(0.5), 0.0)), 0.5);
    for (const double turn : {1e-3, -1e-3, 1e-2, -1e-2}) {
        EXPECT_LT(degreesBetween(exitOf(turn), back), 1000.0 * std::fabs(turn)) << turn;
    }
}

TEST(Corner, AGrazingTouchSkipsContinuously) {
    // Exit direction, exit time and exit place over the incidence: no jump, also where the skip begins.
    struct Exit {
        Vec3 position{0.0}, velocity{0.0};
        double time = 0.0;
        double turned = 0.0;
    };
    const auto exitOf = [](double degrees) {
        World world = worldWithFloor({0, 0, 0});
        const double a = degrees * M_PI / 180.0;
        BodyDef def = ball(0.8, Vec3(-3.0 * std::cos(a), 3.0 * std::sin(a), 0.0) + Vec3(0, 0.6, 0),
                           10.0 * Vec3(std::cos(a), -std::sin(a), 0.0));
        const BodyId body = valueOf(world.addBody(def));
        Exit exit;
        while (exit.time == 0.0) {
            world.step(1.0 / 240.0);
            for (const Event& event : world.events()) {
                exit.time = event.type == EventType::Release ? event.time : exit.time;
            }
            const Phase phase = world.phase(body);
            if (const auto* impact = phase.as<Impact>()) {
                exit.turned = impact->turn_angle;
            }
        }
        exit.velocity = world.velocity(body);
        exit.position = world.pose(body).position - exit.velocity * (world.time() - exit.time);
        return exit;
    };
    Exit before = exitOf(8.0);
    for (double degrees = 8.25; degrees < 60.0; degrees += 0.25) {
        const Exit now = exitOf(degrees);
        EXPECT_LT(glm::length(now.velocity - before.velocity), 0.2) << degrees;
        EXPECT_LT(std::fabs(now.time - before.time), 0.05) << degrees;
        EXPECT_LT(std::fabs(now.position.x - before.position.x), 0.2) << degrees;
        EXPECT_EQ(now.turned < 0.5 * M_PI + 1e-9 && degrees < 30.0, degrees < 30.0) << degrees;
        before = now;
    }
    EXPECT_LT(exitOf(15.0).turned, 35.0 * M_PI / 180.0) << "a small turn";
    EXPECT_GT(exitOf(45.0).turned, 80.0 * M_PI / 180.0) << "the forward swap";
}

/// A room of six planes, aslant, with a few solids: bodies go from corner to corner.
struct Room {
    World world = worldWith();
    std::vector<ObstacleId> obstacles;
    std::vector<ShapePtr> shapes;
};

void addRoom(Room& room, Random& random, bool solids) {
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            Vec3 normal(0.0);
            normal[axis] = -side;
            normal = glm::normalize(normal + random.inBox(0.35));
            room.obstacles.push_back(valueOf(room.world.addObstacle(ObstacleDef::plane(normal, -2.0))));
            room.shapes.push_back(nullptr);
        }
    }
    for (int i = 0; solids && i < 3; ++i) {
        ObstacleDef def;
        def.shape = i == 0   ? valueOf(Shape::box({0.8, 0.6, 0.9}))
                    : i == 1 ? valueOf(Shape::cylinder(0.3, 1.4, 12))
                             : valueOf(Shape::sphere(0.4, 4));
        def.position = random.inBox(1.2);
        def.rotation = random.rotation();
        room.obstacles.push_back(valueOf(room.world.addObstacle(def)));
        room.shapes.push_back(def.shape);
    }
}

struct Depths {
    int impacts = 0, waits = 0, poses = 0;
};

/// Looks at every phase at 8 times, and at every change of phase.
void look(const Room& room, const Track& track, double end_time, int run, Depths& out) {
    const Shape& shape = *track.shape();
    const auto& phases = track.phases();
    for (std::size_t p = 0; p < phases.size(); ++p) {
        const double end = p + 1 < phases.size() ? phases[p + 1].start : end_time;
        const bool impact = phases[p].is<Impact>();
        out.impacts += impact && phases[p].clear_of.empty() ? 1 : 0;
        out.waits += impact && !phases[p].clear_of.empty() ? 1 : 0;
        for (int k = 0; k <= 8; ++k) {
            const double t = phases[p].start + (end - phases[p].start) * k / 8;
            const Pose pose = poseAt(phases[p], shape, t);
            ++out.poses;
            for (std::size_t i = 0; i < room.obstacles.size(); ++i) {
                const MovingFrame& frame = room.world.frame(room.obstacles[i]);
                double gap = 0.0;
                if (room.shapes[i]) {
                    gap = shape.length() *
                          separation(shape, pose, *room.shapes[i], {frame.origin, frame.orientation, 1.0});
                } else {
                    gap = gapTo({frame, Vec3(0.0), room.world.planeNormal(room.obstacles[i]), nullptr}, shape, pose, t);
                }
                ASSERT_GT(gap, -1e-5 * shape.length())
                    << "run " << run << ", " << nameOf(phases[p]) << " at " << t << ", obstacle " << i;
            }
        }
        if (p > 0) {
            const Pose before = poseAt(phases[p - 1], shape, phases[p].start);
            const Pose after = poseAt(phases[p], shape, phases[p].start);
            ASSERT_LT(glm::length(before.position - after.position), 1e-6 * shape.length())
                << "run " << run << ", " << nameOf(phases[p - 1]) << " to " << nameOf(phases[p]) << " at "
                << phases[p].start;
            ASSERT_NEAR(before.stretch, after.stretch, 1e-6) << run;
            ASSERT_LT(angleBetween(before.orientation, after.orientation), 1e-6) << run;
        }
    }
}

TEST(Corner, RandomRoomsHoldTheirBounds) {
    Random random(43);
    const ShapePtr bodies[] = {valueOf(Shape::sphere(0.3, 4)), valueOf(Shape::cylinder(0.15, 0.8, 12)),
                               valueOf(Shape::box({0.3, 0.6, 0.5})), valueOf(Shape::cone(0.3, 0.6, 12)),
                               valueOf(Shape::capsule(0.15, 0.9, 8))};
    Depths depths;
    for (int i = 0; i < 100 * soak(); ++i) {
        Room room;
        addRoom(room, random, i % 2 == 1);
        BodyDef def;
        def.shape = bodies[i % 5];
        def.style.restitution = random.uniform(0.2, 1.0);
        def.style.max_stretch = random.uniform(1.1, 2.5);
        def.style.min_squash = random.uniform(0.3, 0.9);
        def.position = random.inBox(0.9);
        def.velocity = random.inBox(8.0);
        if (room.world.overlapOf(def)) {
            continue;
        }
        (void)valueOf(room.world.addBody(def));
        Timeline timeline;
        timeline.begin(room.world);
        for (int k = 0; k < 240; ++k) {
            room.world.step(1.0 / 60.0);
            timeline.capture(room.world);
        }
        ASSERT_NO_FATAL_FAILURE(look(room, timeline.tracks()[0], room.world.time(), i, depths));
    }
    EXPECT_GT(depths.impacts, 300);
    EXPECT_GT(depths.waits, 100) << "corners were hit";
}

} // namespace
} // namespace elastoon
