// The deterministic functions against the system's extended precision.
#include "dmath.h"
#include "test_support.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace elastoon {
namespace {

/// Angles of every kind that the simulation makes: even, about the multiples of pi/4, tiny.
double anyAngle(Random& random, double most) {
    switch (random.below(3)) {
    case 0:
        return random.uniform(-most, most);
    case 1:
        return std::floor(random.uniform(-most, most) / (0.25 * kPi)) * (0.25 * kPi) + random.uniform(-1e-9, 1e-9);
    default:
        return random.uniform(-1.0, 1.0) * std::pow(10.0, random.uniform(-300.0, 0.0));
    }
}

/// Greatest error of both against extended precision.
double worstSinCos(std::uint64_t seed, int count, double most) {
    Random random(seed);
    long double worst = 0.0;
    for (int i = 0; i < count; ++i) {
        const double angle = anyAngle(random, most);
        const SinCos got = detSinCos(angle);
        worst = std::max(worst, std::fabs(got.sin - std::sin(static_cast<long double>(angle))));
        worst = std::max(worst, std::fabs(got.cos - std::cos(static_cast<long double>(angle))));
    }
    return static_cast<double>(worst);
}

TEST(Dmath, ExtendedPrecisionIsABetterOracle) {
    ASSERT_GE(std::numeric_limits<long double>::digits, 64);
}

TEST(Dmath, SinCosMeetTheirStatedError) {
    EXPECT_LT(worstSinCos(1, 300000, 100.0), 4e-16);
    EXPECT_LT(worstSinCos(2, 300000, 1e5), 4e-16);
    EXPECT_LT(worstSinCos(3, 300000, 1e6), 4e-16);
    // Beyond, the error grows as the last digit of the angle does.
    EXPECT_LT(worstSinCos(4, 100000, 1e9), 1e-6);
}

TEST(Dmath, SinCosOfSpecialAngles) {
    EXPECT_EQ(detSinCos(0.0).sin, 0.0);
    EXPECT_EQ(detSinCos(0.0).cos, 1.0);
    EXPECT_FALSE(std::signbit(detSinCos(0.0).sin));
    EXPECT_TRUE(std::signbit(detSinCos(-0.0).sin));
    EXPECT_EQ(detSinCos(-0.0).cos, 1.0);
    EXPECT_EQ(detSinCos(0x1p-1074).sin, 0x1p-1074);
    EXPECT_EQ(detSinCos(0x1p-1022).sin, 0x1p-1022);
    for (int k = -2000; k <= 2000; ++k) {
        // The double nearest to a multiple of pi is not one: its sine is what is missing, in full precision.
        const double angle = k * kPi / 4.0;
        const SinCos got = detSinCos(angle);
        EXPECT_NEAR(got.sin, static_cast<double>(std::sin(static_cast<long double>(angle))), 4e-16) << k;
        EXPECT_NEAR(got.cos, static_cast<double>(std::cos(static_cast<long double>(angle))), 4e-16) << k;
        EXPECT_NEAR(got.sin * got.sin + got.cos * got.cos, 1.0, 1e-15) << k;
        const SinCos mirrored = detSinCos(-angle);
        EXPECT_NEAR(mirrored.sin, -got.sin, 0x1p-52) << k;
        EXPECT_NEAR(mirrored.cos, got.cos, 0x1p-52) << k;
    }
    EXPECT_EQ(detSinCos(kPi).cos, -1.0);
    EXPECT_EQ(detSinCos(kPi / 2).sin, 1.0);
    EXPECT_EQ(detSinCos(-kPi / 2).sin, -1.0);
}

TEST(Dmath, SinIsContinuousWhereTheReductionChanges) {
    for (int k = -1001; k <= 1001; k += 2) {
        const double edge = k * kPi / 4.0;
        const SinCos below = detSinCos(std::nextafter(edge, -1e9)), above = detSinCos(std::nextafter(edge, 1e9));
        const double step = std::nextafter(edge, 1e9) - std::nextafter(edge, -1e9);
        EXPECT_LT(std::fabs(above.sin - below.sin), step + 8e-16) << k;
        EXPECT_LT(std::fabs(above.cos - below.cos), step + 8e-16) << k;
    }
}

TEST(Dmath, Atan2AndAcosMeetTheirStatedError) {
    Random random(3);
    long double worst = 0.0;
    for (int i = 0; i < 300000; ++i) {
        const double scale = std::pow(10.0, random.uniform(-12.0, 12.0));
        const double x = random.uniform(-1.0, 1.0);
        const double y = random.uniform(-1.0, 1.0) * (i % 2 == 0 ? 1.0 : scale);
        worst = std::max(worst, std::fabs(detAtan2(y, x) - std::atan2(static_cast<long double>(y), x)));
        worst = std::max(worst, std::fabs(detAcos(x) - std::acos(static_cast<long double>(x))));
        // Near the ends acos is steep: what 1 - x keeps counts.
        const double near_one = (i % 2 == 0 ? 1.0 : -1.0) * (1.0 - std::fabs(x) * std::min(1.0, scale * 1e-4));
        worst = std::max(worst, std::fabs(detAcos(near_one) - std::acos(static_cast<long double>(near_one))));
    }
    EXPECT_LT(worst, 1e-15);
}

TEST(Dmath, Atan2OnTheAxesAndDiagonals) {
    for (const double r : {0x1p-1074, 1e-300, 1e-8, 1.0, 3.0, 1e8, 1e300}) {
        EXPECT_EQ(detAtan2(0.0, r), 0.0) << r;
        EXPECT_EQ(detAtan2(0.0, -r), kPi) << r;
        EXPECT_EQ(detAtan2(r, 0.0), kPi / 2) << r;
        EXPECT_EQ(detAtan2(-r, 0.0), -kPi / 2) << r;
        EXPECT_NEAR(detAtan2(r, r), kPi / 4, 2e-16) << r;
        EXPECT_NEAR(detAtan2(r, -r), 3 * kPi / 4, 5e-16) << r;
        EXPECT_EQ(detAtan2(-r, r), -detAtan2(r, r)) << r;
        EXPECT_EQ(detAtan2(-r, -r), -detAtan2(r, -r)) << r;
    }
    // A zero has no sign here: both are the angle 0 or pi.
    for (const double zero : {0.0, -0.0}) {
        EXPECT_EQ(detAtan2(zero, 0.0), 0.0);
        EXPECT_EQ(detAtan2(zero, -0.0), 0.0);
        EXPECT_EQ(detAtan2(zero, 1.0), 0.0);
        EXPECT_EQ(detAtan2(zero, -1.0), kPi);
        EXPECT_EQ(detAtan2(1.0, zero), kPi / 2);
    }
}

TEST(Dmath, AcosOfSpecialNumbers) {
    EXPECT_EQ(detAcos(1.0), 0.0);
    EXPECT_EQ(detAcos(-1.0), kPi);
    EXPECT_EQ(detAcos(0.0), kPi / 2);
    EXPECT_EQ(detAcos(-0.0), kPi / 2);
    EXPECT_NEAR(detAcos(0.5), kPi / 3, 1e-15);
    EXPECT_EQ(detAcos(1.5), 0.0);
    EXPECT_EQ(detAcos(-1.5), kPi);
    EXPECT_EQ(detAcos(std::nextafter(1.0, 2.0)), 0.0);
    const double below_one = std::nextafter(1.0, 0.0);
    EXPECT_NEAR(detAcos(below_one), static_cast<double>(std::acos(static_cast<long double>(below_one))), 1e-20);
    EXPECT_LT(detAcos(-below_one), kPi);
}

} // namespace
} // namespace elastoon
