// The boxes against dense sampling of what they hold.
#include "swept_box.h"

#include "flight.h"
#include "test_support.h"

#include <algorithm>

namespace elastoon {
namespace {

TEST(SweptBox, OfAnInstantIsExact) {
    const ShapePtr shape = valueOf(Shape::box({2.0, 4.0, 6.0}));
    MovingFrame frame;
    frame.origin = {10.0, 0.0, 0.0};
    frame.velocity = {1.0, 0.0, 0.0};
    frame.orientation = {std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)}; // a quarter turn about z
    const Box box = boxOf(*shape, frame, 3.0);
    EXPECT_LT(glm::length(box.low - Vec3(11.0, -1.0, -3.0)), 1e-14);
    EXPECT_LT(glm::length(box.high - Vec3(15.0, 1.0, 3.0)), 1e-14);
}

MovingFrame randomFrame(Random& random) {
    MovingFrame frame;
    frame.start = random.uniform(-5.0, 5.0);
    frame.origin = random.inBox(std::pow(10.0, random.uniform(-1.0, 6.0)));
    frame.orientation = random.rotation();
    frame.velocity = random.inBox(random.below(3) == 0 ? 0.0 : 10.0);
    frame.angular_velocity = random.below(3) == 0 ? Vec3(0.0) : random.inBox(std::pow(10.0, random.uniform(-3.0, 2.0)));
    return frame;
}

ShapePtr randomShape(Random& random) {
    switch (random.below(4)) {
    case 0:
        return valueOf(Shape::box(Vec3(0.1) + glm::abs(random.inBox(3.0))));
    case 1:
        return valueOf(Shape::cone(random.uniform(0.1, 1.0), random.uniform(0.1, 5.0), 16));
    case 2:
        return valueOf(Shape::capsule(0.3, random.uniform(0.6, 9.0), 8));
    default:
        return valueOf(Shape::sphere(random.uniform(0.1, 1.0), 4));
    }
}

/// By how much the corner reaches out of the box, m.
double outOf(const Box& box, const Vec3& corner) {
    const Vec3 out = glm::max(box.low - corner, corner - box.high);
    return std::max({out.x, out.y, out.z});
}

TEST(SweptBox, HoldsAMovingObstacle) {
    Random random(76);
    for (int run = 0; run < 300 * soak(); ++run) {
        const ShapePtr shape = randomShape(random);
        const MovingFrame frame = randomFrame(random);
        const double from = random.uniform(-5.0, 5.0);
        const double to = from + std::pow(10.0, random.uniform(-4.0, 0.5));
        const Box box = sweptBox(*shape, frame, from, to);
        Box needed = boxOf(*shape, frame, from);
        for (int i = 0; i <= 200; ++i) {
            const double t = i == 200 ? to : from + (to - from) * i / 200.0;
            for (const Vec3& vertex : shape->vertices()) {
                ASSERT_LE(outOf(box, frame.worldFromFrame(t, vertex)), 0.0) << "run " << run;
            }
            needed = unionOf(needed, boxOf(*shape, frame, t));
        }
        // Nor much larger than that: within a sphere's play.
        const Vec3 excess = glm::max(needed.low - box.low, box.high - needed.high);
        const double turned = glm::length(frame.angular_velocity) * (to - from);
        const double most = turned > 6.2 ? 2.0 * shape->boundingRadius() : 0.012 * shape->boundingRadius();
        EXPECT_LE(std::max({excess.x, excess.y, excess.z}), most + 1e-8) << "run " << run;
    }
}

TEST(SweptBox, HoldsABodyInFlight) {
    Random random(77);
    int pushed = 0;
    for (int run = 0; run < 400 * soak(); ++run) {
        const ShapePtr shape = randomShape(random);
        Style style;
        style.max_stretch = random.uniform(1.0, 3.0);
        const Vec3 gravity = random.below(4) == 0 ? Vec3(0.0) : random.inBox(10.0);
        Phase phase;
        phase.start = random.uniform(0.0, 100.0);
        const Pose pose{random.inBox(std::pow(10.0, random.uniform(0.0, 4.0))), random.rotation(), 1.0};
        const Vec3 velocity = random.below(8) == 0 ? Vec3(0.0) : random.inBox(10.0);
        const Flight flight = beginFlight(pose, velocity, gravity, style, Lead::PlusX);
        for (int kept = random.below(3); kept > 0; --kept) {
            KeptClear leaving;
            leaving.surface.frame = randomFrame(random);
            leaving.surface.normal = random.direction();
            const Vec3 normal = leaving.surface.normalAt(phase.start);
            leaving.surface.point = leaving.surface.frame.frameFromWorld(
                phase.start, pose.position - normal * random.uniform(-0.2, 1.0) * shape->boundingRadius());
            leaving.until = phase.start + random.uniform(0.0, 2.0);
            phase.clear_of.push_back(leaving);
        }
        phase.motion = flight;
        const double from = phase.start + (random.below(2) == 0 ? 0.0 : random.uniform(0.0, 2.0));
        const double to = from + std::pow(10.0, random.uniform(-4.0, 0.5));
        const Box box = sweptBox(phase, *shape, from, to);
        for (int i = 0; i <= 200; ++i) {
            const double t = i == 200 ? to : from + (to - from) * i / 200.0;
            const Pose at = poseAt(phase, *shape, t);
            pushed += at.position != unpushedPose(flight, t - phase.start).position ? 1 : 0;
            for (const Vec3& vertex : shape->vertices()) {
                ASSERT_LE(outOf(box, worldFromShape(at, vertex)), 0.0) << "run " << run;
            }
        }
    }
    EXPECT_GT(pushed, 1000);
}

TEST(SweptBox, OfAThrowIsTheParabolaAndTheReach) {
    const ShapePtr ball = valueOf(Shape::sphere(0.5));
    Style style;
    style.max_stretch = 1.0;
    Phase phase;
    phase.motion = beginFlight({}, {3.0, 10.0, 0.0}, {0.0, -10.0, 0.0}, style, Lead::PlusX);
    const Box box = sweptBox(phase, *ball, 0.5, 2.0);
    const double reach = flightBounds(phase.get<Flight>(), *ball, 0.5, 2.0).reach;
    EXPECT_LT(glm::length(box.low - Vec3(1.5 - reach, -reach, -reach)), 1e-12);
    EXPECT_LT(glm::length(box.high - Vec3(6.0 + reach, 5.0 + reach, reach)), 1e-12);
}

} // namespace
} // namespace elastoon
