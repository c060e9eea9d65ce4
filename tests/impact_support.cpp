// See impact_support.h.
#include "impact_support.h"

#include "contact.h"
#include "flight.h"
#include "impact.h"
#include "room.h"
#include "touch.h"
#include "watch.h"

#include <cmath>

namespace elastoon {

std::optional<Struck> randomImpact(Random& random, int i) {
    static const ShapePtr shapes[] = {valueOf(Shape::box({0.3, 1.0, 0.5})), valueOf(Shape::cylinder(0.2, 1.5)),
                                      valueOf(Shape::cone(0.5, 1.0))};
    Struck struck;
    struck.shape = shapes[i % 3];
    Touching touching;
    touching.pose.orientation = random.rotation();
    touching.pose.stretch = random.uniform(1.0, 1.5);
    touching.pose.position = {0.0, 0.0, 0.0};
    touching.pose.position.y = -gapTo(touching.surface, *struck.shape, touching.pose, 0.0);
    touching.velocity = random.inBox(6.0);
    touching.velocity.y = -std::fabs(touching.velocity.y);
    touching.gravity = {0.0, -9.81, 0.0};
    Style style;
    style.restitution = random.uniform(0.0, 1.0);
    style.max_stretch = 1.6;
    auto impact = beginImpact(touching, *struck.shape, style);
    if (!impact) {
        return std::nullopt;
    }
    if (i % 2 == 0) {
        // Three decades of durations, down to where the bounds of both halves together would be useless.
        const double brief = std::pow(10.0, -random.uniform(3.0, 9.0));
        (i % 4 == 0 ? impact->curve.t_in : impact->curve.t_out) *= brief;
        (i % 4 == 0 ? impact->curve.omega_in : impact->curve.omega_out) /= brief;
    }
    struck.phase.end = impact->begun + impact->curve.duration();
    struck.phase.motion = *impact;
    return struck;
}

namespace {

/// Half as far from the body as what is near to it.
KeptClear nearPlane(const Vec3& normal, const Shape& shape, const Pose& pose) {
    KeptClear kept;
    kept.surface.normal = normal;
    kept.surface.point = pose.position;
    const double gap = gapTo(kept.surface, shape, pose, 0.0);
    kept.surface.point += normal * (gap - 0.5 * kNearGap * shape.length());
    return kept;
}

} // namespace

std::optional<Struck> randomImpactByWall(Random& random, int i) {
    auto struck = randomImpact(random, i);
    if (struck) {
        const Pose pose = poseAt(struck->phase, *struck->shape, struck->phase.start);
        struck->phase.clear_of.push_back(nearPlane(random.direction(), *struck->shape, pose));
    }
    return struck;
}

std::optional<Struck> randomSteepImpact(Random& random, int i) {
    static const ShapePtr ground = valueOf(Shape::box({1.0, 0.8, 1.2}));
    std::optional<Struck> struck = randomImpact(random, 1);
    if (!struck) {
        return std::nullopt;
    }
    Style style;
    style.restitution = random.uniform(0.0, 1.0);
    style.max_stretch = 1.6;
    const Pose begin{2.5 * random.direction(), random.rotation(), 1.0};
    Phase flight;
    flight.motion = beginFlight(begin, -random.uniform(1.0, 3.0) * begin.position + random.inBox(1.0),
                                {0.0, -9.81, 0.0}, style, Lead::Nearest);
    MovingFrame frame;
    frame.orientation = random.rotation();
    ClosestSeed seed;
    const auto touch = firstSolidTouch(flight, *struck->shape, ground, frame, 0.0, 2.0, seed);
    if (!touch || touch->time <= 0.0) {
        return std::nullopt;
    }
    Touching touching;
    touching.pose = poseAt(flight, *struck->shape, touch->time);
    touching.velocity = velocityAt(flight, *struck->shape, touch->time);
    touching.gravity = {0.0, -9.81, 0.0};
    touching.surface = touch->surface;
    const auto impact = beginImpact(touching, *struck->shape, style);
    if (!impact) {
        return std::nullopt;
    }
    struck->phase.end = impact->begun + impact->curve.duration();
    struck->phase.start = impact->begun;
    struck->phase.motion = *impact;
    if (i % 2 == 0) {
        const Vec3 normal = touch->surface.normalAt(0.0);
        const Vec3 across = glm::normalize(glm::cross(normal, random.direction()));
        struck->phase.clear_of.push_back(
            nearPlane(glm::normalize(across + random.uniform(-0.5, 0.5) * normal), *struck->shape, touching.pose));
        struck->phase.end = blockedAt(struck->phase, *struck->shape);
    }
    return struck;
}

} // namespace elastoon
