// The curves of the model against closed forms of their own, and the check figures.
#include "elastoon/model.h"

#include "test_support.h"

#include <cmath>

namespace elastoon {
namespace {

Style paperStyle() {
    Style style;
    style.squash_law = SquashLaw::Paper;
    return style;
}

TEST(Model, CheckFigures) {
    const Style style = paperStyle();
    const double speed = std::sqrt(2.0 * 9.81 * 10.0);
    EXPECT_NEAR(speed, 14.007, 5e-4);
    const ImpactCurve curve = impactCurve(style, {.length = 1.0,
                                                  .speed_in = speed,
                                                  .s_in = stretchAtSpeed(style, speed),
                                                  .speed_out = 0.5 * speed,
                                                  .s_out = stretchAtSpeed(style, 0.5 * speed)});
    EXPECT_NEAR(curve.s_in, 1.5835, 1e-4);
    EXPECT_NEAR(curve.s_mid, 0.6041, 1e-4);
    EXPECT_NEAR(curve.t_in, 0.1098, 1e-4);
    EXPECT_NEAR(curve.s_out, 1.4119, 1e-4);
    EXPECT_NEAR(curve.t_out, 0.1812, 1e-4);
}

TEST(Model, StretchFollowsThePapersEquation) {
    Random random(7);
    for (int i = 0; i < 100000; ++i) {
        Style style;
        style.max_stretch = random.uniform(1.0, 5.0);
        style.stretch_rate = random.uniform(0.0, 2.0);
        const double v = std::pow(10.0, random.uniform(-6.0, 6.0));
        const long double kv = static_cast<long double>(style.stretch_rate) * v;
        const long double expected = (kv * style.max_stretch + 1) / (kv + 1);
        EXPECT_NEAR(stretchAtSpeed(style, v), static_cast<double>(expected), 1e-12);
    }
    EXPECT_EQ(stretchAtSpeed(Style{}, 0.0), 1.0);
    EXPECT_NEAR(stretchAtSpeed(Style{}, 10.0), 1.5, 1e-15) << "half of the extra stretch at speed 1/k";
}

TEST(Model, BothLawsReachMinSquashAtInfiniteSpeed) {
    for (const SquashLaw law : {SquashLaw::Paper, SquashLaw::Bounded}) {
        Style style;
        style.squash_law = law;
        EXPECT_NEAR(deepestSquash(style, 1e12), style.min_squash, 1e-9);
    }
    EXPECT_EQ(deepestSquash(Style{}, 0.0), 1.0);
    EXPECT_NEAR(deepestSquash(paperStyle(), 0.0), 0.75, 1e-15);
}

TEST(Model, BoundedSquashTimeTendsToItsLimitAndThePapersGrows) {
    Style style;
    const auto squashTime = [](const Style& s, double v) {
        return impactCurve(s,
                           {.length = 1.0, .speed_in = v, .s_in = stretchAtSpeed(s, v), .speed_out = v, .s_out = 1.0})
            .t_in;
    };
    EXPECT_NEAR(squashTime(style, 1e-6), M_PI / 2 * 1.0 * 0.1 * 1.5, 1e-6);
    EXPECT_NEAR(squashTime(paperStyle(), 0.1), 4.1214, 1e-4);
    EXPECT_LT(squashTime(style, 0.1), 0.236);
}

TEST(Model, CurveIsContinuousAndStartsAtTheRightSpeed) {
    Random random(8);
    for (int i = 0; i < 2000; ++i) {
        Style style;
        style.squash_law = i % 2 == 0 ? SquashLaw::Paper : SquashLaw::Bounded;
        style.max_stretch = random.uniform(1.1, 4.0);
        style.min_squash = random.uniform(0.05, 0.95);
        style.squash_rate = random.uniform(0.3, 3.0);
        const double v = random.uniform(1.0, 50.0);
        const double length = random.uniform(0.1, 10.0);
        const ImpactCurve c = impactCurve(style, {.length = length,
                                                  .speed_in = v,
                                                  .s_in = stretchAtSpeed(style, v),
                                                  .speed_out = 0.6 * v,
                                                  .s_out = stretchAtSpeed(style, 0.6 * v)});
        EXPECT_EQ(c.at(0.0), c.s_in);
        EXPECT_NEAR(c.at(c.t_in), c.s_mid, 1e-12);
        EXPECT_NEAR(c.at(c.t_in * (1 - 1e-12)), c.s_mid, 1e-9);
        EXPECT_EQ(c.at(c.duration()), c.s_out);
        EXPECT_NEAR(c.at(c.duration() * (1 - 1e-13)), c.s_out, 1e-9);
        // Paper, section 3.4: -l ds/dt = k_sq v at the touch.
        const double h = 1e-6 * c.t_in;
        EXPECT_NEAR(-length * (c.at(h) - c.at(0.0)) / h, style.squash_rate * v, 1e-4 * v * style.squash_rate);
    }
}

TEST(Model, ZeroSpansTakeNoTimeAndDivideNothing) {
    Style rigid;
    rigid.max_stretch = rigid.min_squash = 1.0;
    Style flat;
    flat.stretch_rate = 0.0;
    for (const Style& style : {rigid, flat}) {
        for (const double v : {0.0, 1e-300, 1.0, 1e6}) {
            const ImpactCurve c = impactCurve(style, {.length = 1.0, .speed_in = v, .speed_out = v, .turns = false});
            EXPECT_EQ(c.duration(), 0.0);
            EXPECT_EQ(c.at(0.0), 1.0);
            const ImpactCurve turning =
                impactCurve(style, {.length = 1.0, .speed_in = v, .speed_out = v, .turns = true});
            EXPECT_NEAR(turning.duration(), 0.04, 1e-12) << "a turn takes time";
            EXPECT_EQ(turning.at(0.03), 1.0);
        }
    }
    for (const SquashLaw law : {SquashLaw::Paper, SquashLaw::Bounded}) {
        Style style;
        style.squash_law = law;
        EXPECT_EQ(impactCurve(style, {.length = 1.0}).duration(), 0.0) << "no speed, no turn";
    }
    EXPECT_GT(impactCurve(Style{}, {.length = 1.0, .turns = true}).duration(), 0.0) << "a turn takes time";
}

TEST(Model, StretchHalfEndsAlsoWithoutOutgoingSpeed) {
    const Style style;
    const ImpactCurve c =
        impactCurve(style, {.length = 1.0, .speed_in = 3.0, .s_in = stretchAtSpeed(style, 3.0), .speed_out = 0.0});
    EXPECT_NEAR(c.omega_out, 0.5 * c.omega_in, 1e-12);
}

TEST(Model, TurnShareIsHalfAtTheDeepestSquashAndMonotone) {
    ImpactCurve curve;
    for (const auto& [t_in, t_out] :
         {std::pair(0.1, 0.3), std::pair(0.3, 0.1), std::pair(0.2, 0.2), std::pair(0.0, 0.2), std::pair(0.2, 0.0)}) {
        curve.t_in = t_in;
        curve.t_out = t_out;
        for (const ImpactEasing easing : {ImpactEasing::Linear, ImpactEasing::Smooth}) {
            if (t_in > 0.0 && t_out > 0.0) {
                EXPECT_NEAR(turnShare(curve, easing, t_in), 0.5, 1e-15);
            }
            double before = 0.0;
            for (int i = 0; i <= 1000; ++i) {
                const double share = turnShare(curve, easing, curve.duration() * i / 1000);
                EXPECT_GE(share, before - 1e-15);
                EXPECT_LT(share - before, 0.01) << "no jump";
                before = share;
            }
            EXPECT_EQ(turnShare(curve, easing, 0.0), 0.0);
            EXPECT_EQ(turnShare(curve, easing, curve.duration()), 1.0);
        }
        // Smooth: no corner at the ends, nor in the middle.
        const auto rate = [&](double t) {
            const double h = 1e-7;
            return (turnShare(curve, ImpactEasing::Smooth, t + h) - turnShare(curve, ImpactEasing::Smooth, t - h)) /
                   (2 * h);
        };
        EXPECT_NEAR(rate(1e-6), 0.0, 1e-3);
        EXPECT_NEAR(rate(curve.duration() - 1e-6), 0.0, 1e-3);
        if (t_in > 0.0 && t_out > 0.0) {
            EXPECT_NEAR(rate(t_in - 1e-6), rate(t_in + 1e-6), 1e-3);
        }
    }
}

} // namespace
} // namespace elastoon
