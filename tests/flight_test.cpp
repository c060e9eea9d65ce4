// Flight: ballistic path, stretch by speed, the axis along the velocity, and steep throws that do not spin over.
#include "flight.h"
#include "rotation.h"
#include "test_support.h"

#include <cmath>

namespace elastoon {
namespace {

const Vec3 kGravity(0.0, -9.81, 0.0);

Flight flightOf(const Vec3& velocity, const Vec3& gravity = kGravity, const Style& style = {}) {
    return beginFlight(Pose{}, velocity, gravity, style, Lead::PlusX);
}

TEST(Flight, IsBallisticAndStretchedBySpeed) {
    Random random(12);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 v0 = random.inBox(20.0);
        const Vec3 g = random.inBox(10.0);
        const double t = random.uniform(0.0, 3.0);
        Style style;
        style.max_stretch = random.uniform(1.0, 4.0);
        const Flight flight = flightOf(v0, g, style);
        const Pose pose = unpushedPose(flight, t);
        EXPECT_LT(glm::length(pose.position - (v0 * t + 0.5 * t * t * g)), 1e-12);
        EXPECT_NEAR(pose.stretch, stretchAtSpeed(style, glm::length(v0 + g * t)), 1e-12);
        EXPECT_NEAR(glm::determinant(linearOf(pose)), 1.0, 1e-12);
        EXPECT_NEAR(glm::length(pose.orientation), 1.0, 1e-14);
    }
}

TEST(Flight, FlatThrowFollowsItsVelocityExactly) {
    Random random(13);
    for (int i = 0; i < 2000; ++i) {
        const double level = random.uniform(1.0, 30.0);
        const Flight flight = flightOf({level, random.uniform(-20.0, 20.0), 0.0});
        ASSERT_EQ(flight.rule, AxisRule::Velocity);
        const double t = random.uniform(0.0, 4.0);
        const Vec3 axis = principalAxis(unpushedPose(flight, t).orientation);
        EXPECT_LT(glm::length(axis - glm::normalize(flightVelocity(flight, t))), 1e-12);
    }
}

TEST(Flight, HasNoRollAboutTheAxis) {
    // Smallest rotation between two headings: a vector across both stays as it is.
    const Flight flight = flightOf({5.0, 10.0, 0.0});
    const Quat turn = unpushedPose(flight, 1.7).orientation * glm::conjugate(flight.orientation);
    EXPECT_LT(glm::length(turn * Vec3(0, 0, 1) - Vec3(0, 0, 1)), 1e-14);
}

TEST(Flight, SteepThrowNeverTurnsFasterThanTheReversalRate) {
    for (const double level : {0.01, 0.1, 0.5}) {
        const Flight flight = flightOf({level, 9.81, 0.0});
        ASSERT_EQ(flight.rule, AxisRule::Reversal);
        double fastest = 0.0;
        const double h = 1e-5;
        for (double t = 0.0; t < 2.0; t += h) {
            fastest = std::max(
                fastest,
                angleBetween(unpushedPose(flight, t).orientation, unpushedPose(flight, t + h).orientation) / h);
        }
        EXPECT_LE(fastest, Style{}.reversal_rate * (1.0 + 1e-4)) << level;
        // The forward end is swapped: away from the apex the axis lies along the velocity, the other end leading.
        const Vec3 axis = principalAxis(unpushedPose(flight, 2.0).orientation);
        EXPECT_LT(angleBetweenAxes(axis, flightVelocity(flight, 2.0)), 0.01) << level;
        EXPECT_LT(glm::dot(axis, flightVelocity(flight, 2.0)), 0.0) << level;
    }
}

TEST(Flight, TheRulesMeetWhereTheyChange) {
    // At v_h = |g| / reversal_rate both rules turn at the reversal rate at the apex.
    const double epsilon = 9.81 / Style{}.reversal_rate;
    for (const double factor : {0.999, 1.001}) {
        const Flight flight = flightOf({epsilon * factor, 9.81, 0.0});
        const double h = 1e-6;
        const double rate =
            angleBetween(unpushedPose(flight, 1.0 - h).orientation, unpushedPose(flight, 1.0 + h).orientation) /
            (2 * h);
        EXPECT_NEAR(rate, Style{}.reversal_rate, 0.02 * Style{}.reversal_rate);
    }
}

TEST(Flight, DropAndVerticalThrowDoNotTurn) {
    for (const double up : {0.0, 7.0, -7.0}) {
        const Flight flight = flightOf({0.0, up, 0.0});
        for (double t = 0.0; t < 2.0; t += 0.01) {
            EXPECT_LT(angleBetween(unpushedPose(flight, t).orientation, flight.orientation), 1e-12);
        }
    }
    EXPECT_LT(glm::length(principalAxis(flightOf(Vec3(0.0)).orientation) - Vec3(0, -1, 0)), 1e-15)
        << "at rest the heading is where gravity will pull";
}

TEST(Flight, IsTurnedToItsHeadingAndKeepsItsRoll) {
    Random random(14);
    for (int i = 0; i < 500; ++i) {
        const Pose pose{Vec3(0.0), random.rotation(), 1.0};
        const Vec3 velocity = random.inBox(10.0) + Vec3(0.0, 0.0, 2.0);
        const Flight first = beginFlight(pose, velocity, kGravity, Style{}, Lead::PlusX);
        const Vec3 axis = principalAxis(unpushedPose(first, 0.0).orientation);
        const Vec3 heading = leadingAxis(first, 0.0);
        EXPECT_LT(glm::length(axis - heading), 1e-12);
        const Flight nearest = beginFlight(pose, velocity, kGravity, Style{}, Lead::Nearest);
        EXPECT_LT(angleBetween(pose.orientation, unpushedPose(nearest, 0.0).orientation), M_PI / 2 + 1e-12);
    }
}

TEST(Flight, WithoutGravityOrSpeedIsStill) {
    const Flight still = flightOf(Vec3(0.0), Vec3(0.0));
    EXPECT_EQ(still.rule, AxisRule::Fixed);
    EXPECT_EQ(unpushedPose(still, 1e5).position, Vec3(0.0));
    const Flight straight = flightOf({1.0, 2.0, 3.0}, Vec3(0.0));
    EXPECT_LT(angleBetween(unpushedPose(straight, 0.0).orientation, unpushedPose(straight, 1e5).orientation), 1e-12);
}

TEST(Flight, BoundsHoldAtEveryTime) {
    Random random(15);
    const ShapePtr shape = valueOf(Shape::cylinder(0.3, 2.0));
    for (int i = 0; i < 3000; ++i) {
        Style style;
        style.max_stretch = random.uniform(1.0, 4.0);
        style.stretch_rate = random.uniform(0.0, 0.5);
        Flight flight = flightOf(random.inBox(random.uniform(0.1, 15.0)), kGravity, style);
        const double from = random.uniform(0.0, 2.0);
        if (i % 2 == 0) {
            easeFrom(flight, {Vec3(0.0), random.rotation(), random.uniform(0.1, 4.0)}, random.uniform(0.1, 3.0));
        }
        const double to = from + random.uniform(0.0, 1.0);
        const FlightBounds bounds = flightBounds(flight, *shape, from, to);
        const double shape_rate = mostShapeRate(flight, *shape, from, to, bounds);
        const double t = random.uniform(from, to);
        const double h = 1e-7;
        const Pose a = unpushedPose(flight, t);
        const Pose b = unpushedPose(flight, t + h);
        EXPECT_LE(glm::length(flightVelocity(flight, t)), bounds.speed * (1 + 1e-9));
        EXPECT_GE(a.stretch, std::min(1.0, unpushedPose(flight, 0.0).stretch / style.max_stretch));
        for (const Vec3& vertex : shape->vertices()) {
            const Vec3 x = worldFromShape(a, vertex) - a.position;
            const Vec3 y = worldFromShape(b, vertex) - b.position;
            EXPECT_LE(glm::length(x), bounds.reach * (1 + 1e-12));
            EXPECT_LE(glm::length(y - x) / h, shape_rate * 1.001 + 1e-5);
        }
    }
}

} // namespace
} // namespace elastoon
