// The watch over a body that is held, against looking very often: nothing is missed, nothing is found too late.
#include "watch.h"

#include "contact.h"
#include "impact.h"
#include "test_support.h"

#include <algorithm>
#include <cmath>

namespace elastoon {
namespace {

/// An impact on the ground, and when it ends.
struct Struck {
    Phase phase;
    ShapePtr shape;
};

/// One half of the curve may take hardly any time: then it is fast.
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

Watched randomWatched(Random& random, int i) {
    static const ShapePtr solid = valueOf(Shape::box({0.6, 0.8, 0.4}));
    Watched watched;
    watched.normal = random.direction();
    watched.frame.orientation = random.rotation();
    if (i % 2 == 0) {
        watched.solid = solid;
        watched.frame.origin = random.direction() * random.uniform(0.7, 1.8) + Vec3(0.0, 0.5, 0.0);
    } else {
        watched.frame.origin = -random.uniform(0.2, 1.6) * (watched.frame.orientation * watched.normal);
    }
    if (i % 5 == 0) {
        watched.frame.velocity = random.inBox(2.0);
    }
    return watched;
}

/// First of very many looks at which one of them is within the gap; infinite if none is.
double firstLookNear(const Struck& struck, std::span<const Watched> all, double gap, double share) {
    constexpr int kLooks = 4000;
    for (int k = 0; k <= kLooks; ++k) {
        const double t = struck.phase.end * k / kLooks;
        const Pose pose = poseAt(struck.phase, *struck.shape, t);
        for (const Watched& watched : all) {
            ClosestSeed cold;
            if (distanceTo(watched, *struck.shape, pose, t, cold).gap <= share * gap) {
                return t;
            }
        }
    }
    return std::numeric_limits<double>::infinity();
}

TEST(Watch, FindsWhatLookingVeryOftenFinds) {
    Random random(4711);
    int near = 0;
    int apart = 0;
    for (int i = 0; i < 300; ++i) {
        const auto struck = randomImpact(random, i);
        if (!struck) {
            continue;
        }
        std::vector<Watched> all;
        ClosestSeed cold;
        const double gap = kNearGap * struck->shape->length();
        for (int k = 0; k < 3; ++k) {
            const Watched watched = randomWatched(random, i + k);
            const Pose pose = poseAt(struck->phase, *struck->shape, 0.0);
            if (distanceTo(watched, *struck->shape, pose, 0.0, cold).gap > 2.0 * gap) {
                all.push_back(watched);
            }
        }
        const double end = struck->phase.end;
        const auto found = firstNear(struck->phase, *struck->shape, all, 0.0, end, gap);
        // To half of the gap it must be found; beyond it, it need not.
        const double seen = firstLookNear(*struck, all, gap, 0.5);
        if (seen < std::numeric_limits<double>::infinity()) {
            ASSERT_TRUE(found) << i << ": first seen at " << seen << " of " << end;
            EXPECT_LE(found->touch.time, seen) << i;
            ++near;
        }
        if (found) {
            const double t = found->touch.time;
            const Pose pose = poseAt(struck->phase, *struck->shape, t);
            EXPECT_LE(distanceTo(*found->watched, *struck->shape, pose, t, cold).gap, gap) << i;
        } else {
            ++apart;
        }
    }
    EXPECT_GT(near, 40);
    EXPECT_GT(apart, 40);
}

} // namespace
} // namespace elastoon
