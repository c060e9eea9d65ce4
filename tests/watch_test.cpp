// The watch over a body that is held, against looking very often: nothing is missed, nothing is found too late.
#include "watch.h"

#include "impact_support.h"
#include "test_support.h"

#include <algorithm>
#include <cmath>

namespace elastoon {
namespace {

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
        const double t = struck.phase.start + (struck.phase.end - struck.phase.start) * k / kLooks;
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

/// How many of the cases came near, and how many stayed apart.
struct Cases {
    int near = 0;
    int apart = 0;
};

/// The watch over three obstacles, against looking very often.
void compare(const Struck& struck, Random& random, int i, Cases& cases) {
    std::vector<Watched> all;
    ClosestSeed cold;
    const double gap = kNearGap * struck.shape->length();
    const Vec3 contact = struck.phase.get<Impact>().surface.pointAt(0.0);
    for (int k = 0; k < 3; ++k) {
        Watched watched = randomWatched(random, i + k);
        watched.frame.origin += contact;
        const Pose pose = poseAt(struck.phase, *struck.shape, struck.phase.start);
        if (distanceTo(watched, *struck.shape, pose, struck.phase.start, cold).gap > 2.0 * gap) {
            all.push_back(watched);
        }
    }
    const auto found = firstNear(struck.phase, *struck.shape, all, struck.phase.start, struck.phase.end, gap);
    // To half of the gap it must be found; beyond it, it need not.
    const double seen = firstLookNear(struck, all, gap, 0.5);
    if (seen < std::numeric_limits<double>::infinity()) {
        ASSERT_TRUE(found) << i << ": first seen at " << seen << " of " << struck.phase.end;
        EXPECT_LE(found->touch.time, seen) << i;
        ++cases.near;
    }
    if (found) {
        // Where what it is kept clear of makes it jump, it may jump right onto another.
        const auto gapAt = [&](double t) {
            const Pose pose = poseAt(struck.phase, *struck.shape, t);
            return distanceTo(*found->watched, *struck.shape, pose, t, cold).gap;
        };
        const double t = found->touch.time;
        EXPECT_TRUE(gapAt(t) <= gap || gapAt(std::nextafter(t, struck.phase.end)) <= 0.0) << i;
    } else {
        ++cases.apart;
    }
}

TEST(Watch, FindsWhatLookingVeryOftenFinds) {
    Random random(4711);
    Cases cases;
    for (int i = 0; i < 300; ++i) {
        if (const auto struck = randomImpact(random, i)) {
            compare(*struck, random, i, cases);
        }
    }
    EXPECT_GT(cases.near, 40);
    EXPECT_GT(cases.apart, 40);
}

TEST(Watch, FindsItOnEdgesAndBesideOthersToo) {
    Random random(815);
    Cases cases;
    const int count = 300 * soak();
    for (int i = 0; i < count; ++i) {
        if (const auto struck = randomSteepImpact(random, i)) {
            compare(*struck, random, i, cases);
        }
    }
    EXPECT_GT(cases.near, count / 8);
    EXPECT_GT(cases.apart, count / 8);
}

} // namespace
} // namespace elastoon
