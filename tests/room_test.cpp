// When a body first finds no room to go on, and when it surely does not.
#include "room.h"

#include "impact_support.h"
#include "push.h"
#include "test_support.h"

#include <cmath>

namespace elastoon {
namespace {

TEST(Room, BlockedIsFoundAtAnyTimeAndInAnySpan) {
    const ShapePtr shape = valueOf(Shape::box({1.0, 1.0, 1.0}));
    for (const double start : {0.0, 1.0, 1e3, 1e6}) {
        for (const double span : {1.0, 1e-4, 1e-8, 1e-12}) {
            Rest rest;
            rest.pose.position = {0.0, 0.5, 0.0};
            KeptClear ceiling;
            ceiling.surface.frame.start = start;
            ceiling.surface.frame.origin = {0.0, 2.0, 0.0};
            ceiling.surface.frame.velocity = {0.0, -2.0 / span, 0.0};
            ceiling.surface.normal = {0.0, -1.0, 0.0};
            Phase phase;
            phase.start = start;
            phase.motion = rest;
            phase.clear_of.push_back(ceiling);
            const double ulp = std::nextafter(start, 1e9) - start;
            EXPECT_NEAR(blockedAt(phase, *shape, start, start + span), start + 0.5 * span, 1e-8 * span + ulp)
                << start << " " << span;
        }
    }
}

/// Of that many looks none finds it without room, nor anywhere else at once.
bool hasRoomAtAll(const Struck& struck, int looks) {
    const Phase& phase = struck.phase;
    const double middle = phase.start + phase.get<Impact>().curve.t_in;
    Fit before = fitted(phase, *struck.shape, phase.start);
    bool has = before.fits;
    for (const auto& [from, to] : {std::pair(phase.start, middle), std::pair(middle, phase.end)}) {
        for (int k = 0; k <= looks && has; ++k) {
            const Fit fit = fitted(phase, *struck.shape, from + (to - from) * k / looks);
            has = fit.fits && glm::length(fit.shift - before.shift) < 0.05 * struck.shape->length();
            before = fit;
        }
    }
    return has;
}

TEST(Room, WhereItSurelyIsEveryLookFindsIt) {
    Random random(44);
    int sure = 0;
    int blocked = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto struck = randomImpactByWall(random, i);
        if (!struck) {
            continue;
        }
        const bool surely = surelyHasRoom(struck->phase, *struck->shape, struck->phase.end);
        const bool has = hasRoomAtAll(*struck, 400);
        EXPECT_TRUE(has || !surely) << i;
        sure += surely ? 1 : 0;
        blocked += has ? 0 : 1;
    }
    EXPECT_GT(sure, 600);
    EXPECT_GT(blocked, 40);
}

} // namespace
} // namespace elastoon
