// Bodies that lie askew under a press: they turn until they fit, and back again.
#include "press_turn.h"

#include "push.h"
#include "rotation.h"
#include "test_support.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace elastoon {
namespace {

constexpr double kClosing = 1.0; ///< s that the press takes
constexpr double kMostSqueeze = 20.0;
constexpr double kLongest = 6.0; ///< of what is turned away from the press's direction
/// Where a body's best form is thickest: tan^2 = 2.
constexpr double kThickest = 0.9553166181245093;

ShapePtr anyShape(Random& random, int kind) {
    switch (kind) {
    case 0:
        return valueOf(Shape::sphere(random.uniform(0.2, 1.0), 4));
    case 1:
        return valueOf(Shape::box({random.uniform(0.3, 1.2), random.uniform(0.3, 1.2), random.uniform(0.3, 1.2)}));
    case 2:
        return valueOf(Shape::cylinder(random.uniform(0.2, 0.6), random.uniform(0.4, 1.2), 16));
    default:
        break;
    }
    const Vec3 half{random.uniform(0.4, 0.8), random.uniform(0.3, 0.6), random.uniform(0.3, 0.6)};
    std::vector<Vec3> points;
    for (int i = 0; i < 40; ++i) {
        points.push_back(half * random.direction());
    }
    return valueOf(Shape::hull(points));
}

struct Heights {
    double least = 1e300, most = -1e300;
    [[nodiscard]] double thickness() const { return most - least; }
};

/// By brute force, along y.
Heights heightsOf(const Shape& shape, const Pose& pose) {
    Heights heights;
    for (const Vec3& vertex : shape.vertices()) {
        const double y = worldFromShape(pose, vertex).y;
        heights = {std::min(heights.least, y), std::max(heights.most, y)};
    }
    return heights;
}

/// Of all forms along the axis that it has, up to a stretch.
double leastThickness(const Shape& shape, Pose pose, double longest = 1e300) {
    const double own = pose.stretch;
    double least = 1e300;
    for (double factor = 1.0 / kMostSqueeze; factor <= std::min(kMostSqueeze, longest / own); factor *= 1.002) {
        pose.stretch = own * factor;
        least = std::min(least, heightsOf(shape, pose).thickness());
    }
    return least;
}

/// A body at rest on the floor y = 0 with its axis at `angle` to the vertical, and a plate that comes down on it until
/// `room` is left, and goes up again.
struct Pressed {
    ShapePtr shape;
    Phase closing, opening;
    double room = 0.0;
    double top = 0.0; ///< of the plate at the start
};

Surface plateAt(double t, double height, double speed) {
    Surface plate;
    plate.frame.start = t;
    plate.frame.origin = {0.3, height, -0.2};
    plate.frame.velocity = {0.0, speed, 0.0};
    plate.normal = {0.0, -1.0, 0.0};
    return plate;
}

Pressed askewUnderAPlate(Random& random, const ShapePtr& shape, double angle, double spare) {
    Pressed pressed;
    pressed.shape = shape;
    Rest rest;
    const Quat anyhow = random.rotation();
    const Quat upright = rotationBetween(principalAxis(anyhow), {0.0, 1.0, 0.0}) * anyhow;
    const double around = random.uniform(0.0, 2.0 * kPi);
    const Vec3 tilt{std::cos(around), 0.0, std::sin(around)};
    rest.pose.orientation = unitOf(rotationAbout(tilt, angle) * upright);
    rest.pose.stretch = random.uniform(0.7, 1.5);
    rest.pose.position = {random.uniform(-1.0, 1.0), 0.0, random.uniform(-1.0, 1.0)};
    rest.pose.position.y = -heightsOf(*shape, rest.pose).least;
    Pose turned = rest.pose;
    turned.orientation = rotationAbout(tilt, angle < kThickest ? -angle : 0.5 * kPi - angle) * turned.orientation;
    pressed.room = spare * leastThickness(*shape, turned, kLongest);
    pressed.top = heightsOf(*shape, rest.pose).most + 0.01;
    const double speed = (pressed.top - pressed.room) / kClosing;
    pressed.closing.motion = rest;
    pressed.opening = pressed.closing;
    pressed.opening.start = kClosing;
    pressed.closing.clear_of = {{.surface = plateAt(0.0, pressed.top, -speed), .obstacle = {}, .presses = true}};
    pressed.opening.clear_of = {{.surface = plateAt(kClosing, pressed.room, speed), .obstacle = {}, .presses = true}};
    return pressed;
}

/// Furthest that a vertex is apart in two poses, as a share of the length.
double apart(const Shape& shape, const Pose& a, const Pose& b) {
    double most = 0.0;
    for (const Vec3& vertex : shape.vertices()) {
        most = std::max(most, glm::length(worldFromShape(a, vertex) - worldFromShape(b, vertex)));
    }
    return most / shape.length();
}

/// What is left of the greatest change within [from, to] in a moment of nothing: a motion's change goes to nothing.
double popWithin(const Phase& phase, const Shape& shape, double from, double to) {
    Pose a = poseAt(phase, shape, from);
    Pose b = poseAt(phase, shape, to);
    for (int i = 0; i < 44 && apart(shape, a, b) > 1e-3; ++i) {
        const double middle = from + 0.5 * (to - from);
        const Pose m = poseAt(phase, shape, middle);
        if (apart(shape, a, m) > apart(shape, m, b)) {
            to = middle;
            b = m;
        } else {
            from = middle;
            a = m;
        }
    }
    return apart(shape, a, b);
}

void expectHeldBetween(const Pressed& pressed, const Phase& phase, const std::string& which) {
    const Shape& shape = *pressed.shape;
    constexpr int kLooks = 50;
    for (int i = 0; i <= kLooks; ++i) {
        const double t = phase.start + kClosing * i / kLooks;
        const Heights heights = heightsOf(shape, poseAt(phase, shape, t));
        ASSERT_GT(heights.least, -1e-6 * shape.length()) << which << " at " << t;
        ASSERT_LT(heights.most, phase.clear_of[0].surface.pointAt(t).y + 1e-6 * shape.length()) << which << " at " << t;
        if (i > 0) {
            ASSERT_LT(popWithin(phase, shape, t - kClosing / kLooks, t), 2e-3) << which << " before " << t;
        }
    }
}

TEST(PressTurn, AnAskewBodyTurnsUntilItFitsAndBackAgain) {
    Random random(71);
    int towards = 0;
    int away = 0;
    for (int i = 0; i < 16 * soak(); ++i) {
        const ShapePtr shape = anyShape(random, i % 4);
        const double angle = random.uniform(0.4, 1.3);
        const Pressed pressed = askewUnderAPlate(random, shape, angle, 1.02);
        const Pose own = pressed.closing.get<Rest>().pose;
        const std::string which = "body " + std::to_string(i) + " at " + std::to_string(angle * 180.0 / kPi);
        ASSERT_GT(leastThickness(*shape, own), 1.01 * pressed.room) << which << ": no form along its axis fits";
        expectHeldBetween(pressed, pressed.closing, which);
        expectHeldBetween(pressed, pressed.opening, which);
        const Pose flat = poseAt(pressed.closing, *shape, kClosing);
        const double axis_at = angleBetweenAxes(principalAxis(flat.orientation), {0.0, 1.0, 0.0});
        ASSERT_GT(std::fabs(axis_at - angle), 0.05) << which;
        ASSERT_EQ(axis_at < angle, angle < kThickest) << which << ": the shorter way";
        ++(axis_at < angle ? towards : away);
        for (const double t : {0.05, 0.4, 0.8}) {
            const double room = pressed.closing.clear_of[0].surface.pointAt(t).y;
            const double again = pressed.opening.clear_of[0].surface.pointAt(2.0 * kClosing - t).y;
            ASSERT_NEAR(room, again, 1e-12);
            ASSERT_LT(
                apart(*shape, poseAt(pressed.closing, *shape, t), poseAt(pressed.opening, *shape, 2.0 * kClosing - t)),
                1e-5)
                << which << " goes back as it came";
        }
        ASSERT_LT(apart(*shape, poseAt(pressed.opening, *shape, 2.0 * kClosing), own), 1e-12) << which;
    }
    EXPECT_GT(towards, 0);
    EXPECT_GT(away, 0);
}

TEST(PressTurn, WithoutRoomTheTurnedBodyIsEnteredSlowly) {
    Random random(72);
    for (int i = 0; i < 8; ++i) {
        const ShapePtr shape = anyShape(random, i % 4);
        const Pressed pressed = askewUnderAPlate(random, shape, random.uniform(0.4, 1.3), 0.3);
        for (int k = 1; k <= 50; ++k) {
            ASSERT_LT(popWithin(pressed.closing, *shape, (k - 1) / 50.0, k / 50.0), 2e-3) << i << " before " << k;
        }
        const Pose flat = poseAt(pressed.closing, *shape, kClosing);
        EXPECT_LT(heightsOf(*shape, flat).thickness(), 1.001 / 0.3 * pressed.room) << i << ": as flat as it gets";
    }
}

} // namespace
} // namespace elastoon
