// The first touch against closed forms and against a dense search.
#include "touch.h"

#include "contact.h"
#include "flight.h"
#include "test_support.h"

#include <cmath>

namespace elastoon {
namespace {

Phase flightPhase(const Flight& flight, double start = 0.0) {
    Phase phase;
    phase.start = start;
    phase.motion = flight;
    return phase;
}

const Surface kFloor;

TEST(Touch, OfADroppedBallIsTheClosedForm) {
    const ShapePtr ball = valueOf(Shape::sphere(0.5));
    for (const double height : {0.6, 1.0, 10.0, 300.0}) {
        const Flight flight = beginFlight({Vec3(0.0, height, 0.0)}, Vec3(0.0), {0, -9.81, 0}, Style{}, Lead::PlusX);
        // Root of h - g t^2 / 2 = r s(g t) by bisection in extended precision.
        long double low = 0.0L;
        long double high = std::sqrt(2.0L * height / 9.81L);
        for (int i = 0; i < 100; ++i) {
            const long double t = (low + high) / 2;
            const long double kv = 0.1L * 9.81L * t;
            (height - 9.81L * t * t / 2 > 0.5L * (2 * kv + 1) / (kv + 1) ? low : high) = t;
        }
        const auto touch = firstTouch(flightPhase(flight), *ball, kFloor, 0.0, 100.0);
        ASSERT_TRUE(touch.has_value());
        EXPECT_NEAR(*touch, static_cast<double>(low), 1e-11 * std::max(1.0, static_cast<double>(low)));
    }
}

TEST(Touch, OfRandomFlightsIsTheFirstAndDoesNotPenetrate) {
    Random random(16);
    const ShapePtr shapes[] = {valueOf(Shape::sphere(0.5)), valueOf(Shape::cylinder(0.2, 1.5)),
                               valueOf(Shape::cone(0.5, 1.0)), valueOf(Shape::box({0.1, 1.0, 0.5}))};
    int touches = 0;
    constexpr int kCases = 3000;
    for (int i = 0; i < kCases; ++i) {
        const Shape& shape = *shapes[i % 4];
        Style style;
        style.max_stretch = random.uniform(1.0, 4.0);
        style.stretch_rate = random.uniform(0.0, 0.5);
        Pose pose;
        pose.position = {0.0, random.uniform(2.0, 6.0), 0.0};
        pose.orientation = random.rotation();
        const Vec3 gravity = i % 5 == 0 ? Vec3(0.0) : Vec3(0.0, -9.81, 0.0);
        Surface surface;
        surface.frame.velocity = i % 3 == 0 ? random.inBox(2.0) : Vec3(0.0);
        surface.frame.angular_velocity = i % 7 == 0 ? random.inBox(0.3) : Vec3(0.0);
        const Phase phase =
            flightPhase(beginFlight(pose, random.inBox(6.0), gravity, style, Lead::PlusX), random.uniform(0.0, 10.0));
        surface.frame.start = phase.start;
        const double end = phase.start + 0.9;
        const auto touch = firstTouch(phase, shape, surface, phase.start, end);
        touches += touch ? 1 : 0;
        const auto gap = [&](double t) { return gapTo(surface, shape, poseAt(phase, shape, t), t); };
        const double until = touch ? *touch : end;
        for (int k = 0; k <= 200; ++k) {
            EXPECT_GT(gap(phase.start + (until - phase.start) * k / 200.0), -1e-12) << i;
        }
        if (touch) {
            EXPECT_LT(gap(*touch), 1.1e-9 * shape.length()) << i;
        }
    }
    EXPECT_GT(touches, kCases * 3 / 10);
    EXPECT_LT(touches, kCases * 7 / 10);
}

TEST(Touch, FastBodyDoesNotTunnel) {
    const ShapePtr grain = valueOf(Shape::sphere(0.005));
    const Flight flight = beginFlight({Vec3(0.0, 50.0, 0.0)}, {0.0, -1000.0, 0.0}, {0, -9.81, 0}, Style{}, Lead::PlusX);
    const auto touch = firstTouch(flightPhase(flight), *grain, kFloor, 0.0, 1.0);
    ASSERT_TRUE(touch.has_value());
    EXPECT_NEAR(*touch, 0.05, 1e-4);
}

TEST(Touch, GrazingPassIsFoundOnlyIfItTouches) {
    // A ball without stretch that rises under upward gravity: its lowest height is known.
    Style rigid;
    rigid.max_stretch = 1.0;
    const ShapePtr ball = valueOf(Shape::sphere(0.5));
    for (const double clearance : {1e-3, 1e-5, 1e-7}) {
        for (const double sign : {1.0, -1.0}) {
            const double height = 0.5 + sign * clearance + 2.0;
            // Falls 2 m against an upward pull of 1 m/s^2, then rises again.
            const Flight flight =
                beginFlight({Vec3(0.0, height, 0.0)}, {0.0, -2.0, 0.0}, {0, 1, 0}, rigid, Lead::PlusX);
            const auto touch = firstTouch(flightPhase(flight), *ball, kFloor, 0.0, 10.0);
            EXPECT_EQ(touch.has_value(), sign < 0.0) << clearance;
        }
    }
}

TEST(Contact, IsTheMiddleOfTheCommonRegion) {
    const ShapePtr box = valueOf(Shape::box({1.0, 2.0, 3.0}));
    EXPECT_LT(glm::length(contactPoint(*box, Pose{}, kFloor, 0.0) - Vec3(0.0, -1.0, 0.0)), 1e-12) << "a face";
    const auto floorOf = [](const Vec3& normal) {
        Surface surface;
        surface.normal = normal;
        return surface;
    };
    const double half = std::sqrt(0.5);
    const Quat tilt(std::cos(M_PI / 8), 0.0, 0.0, std::sin(M_PI / 8));
    const Vec3 edge = contactPoint(*box, {Vec3(0.0), tilt, 1.0}, kFloor, 0.0);
    EXPECT_LT(glm::length(edge - tilt * Vec3(-0.5, -1.0, 0.0)), 1e-12) << "an edge";
    const Vec3 n = glm::normalize(Vec3(half, 0.7, 0.3));
    EXPECT_LT(glm::length(contactPoint(*box, Pose{}, floorOf(n), 0.0) - Vec3(-0.5, -1.0, -1.5)), 1e-12) << "a corner";
    const ShapePtr cone = valueOf(Shape::cone(0.5, 2.0));
    const Pose squashed{Vec3(0.0), kNoRotation, 0.25};
    EXPECT_LT(glm::length(contactPoint(*cone, squashed, floorOf({1, 0, 0}), 0.0) - Vec3(-0.125, 0.0, 0.0)), 1e-12)
        << "a round face";
}

} // namespace
} // namespace elastoon
