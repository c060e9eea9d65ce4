// The deterministic functions against the system's extended precision.
#include "dmath.h"
#include "test_support.h"

#include <cmath>

namespace elastoon {
namespace {

TEST(Dmath, SinCosMeetTheirStatedError) {
    Random random(1);
    double worst = 0.0;
    for (int i = 0; i < 200000; ++i) {
        const double angle = random.uniform(-100.0, 100.0);
        const SinCos got = detSinCos(angle);
        worst = std::max(worst, static_cast<double>(std::fabs(got.sin - std::sin(static_cast<long double>(angle)))));
        worst = std::max(worst, static_cast<double>(std::fabs(got.cos - std::cos(static_cast<long double>(angle)))));
    }
    EXPECT_LT(worst, 4e-16);
}

TEST(Dmath, SinCosHoldForLargeAndTinyAngles) {
    Random random(2);
    for (int i = 0; i < 20000; ++i) {
        const double angle = random.uniform(-1e5, 1e5);
        EXPECT_NEAR(detSinCos(angle).sin, static_cast<double>(std::sin(static_cast<long double>(angle))), 1e-15);
        const double tiny = random.uniform(-1e-8, 1e-8);
        EXPECT_DOUBLE_EQ(detSinCos(tiny).sin, std::sin(tiny));
    }
    EXPECT_EQ(detSinCos(0.0).sin, 0.0);
    EXPECT_EQ(detSinCos(0.0).cos, 1.0);
}

TEST(Dmath, Atan2AndAcosMeetTheirStatedError) {
    Random random(3);
    double worst = 0.0;
    for (int i = 0; i < 200000; ++i) {
        const double scale = std::pow(10.0, random.uniform(-12.0, 12.0));
        const double x = random.uniform(-1.0, 1.0);
        const double y = random.uniform(-1.0, 1.0) * (i % 2 == 0 ? 1.0 : scale);
        const long double atan = std::atan2(static_cast<long double>(y), static_cast<long double>(x));
        worst = std::max(worst, static_cast<double>(std::fabs(detAtan2(y, x) - atan)));
        worst = std::max(worst, static_cast<double>(std::fabs(detAcos(x) - std::acos(static_cast<long double>(x)))));
    }
    EXPECT_LT(worst, 1e-15);
    EXPECT_EQ(detAtan2(0.0, 0.0), 0.0);
    EXPECT_DOUBLE_EQ(detAtan2(0.0, -1.0), kPi);
    EXPECT_DOUBLE_EQ(detAtan2(1.0, 0.0), kPi / 2);
    EXPECT_EQ(detAcos(1.5), 0.0);
    EXPECT_DOUBLE_EQ(detAcos(-1.5), kPi);
}

} // namespace
} // namespace elastoon
