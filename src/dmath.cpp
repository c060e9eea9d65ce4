// See dmath.h. Power series on reduced arguments: their remainders are below 2e-18 there.
#include "dmath.h"

#include <cfloat>
#include <cmath>
#include <cstdint>
#include <limits>

#ifdef __FAST_MATH__
#error "Elastoon needs IEEE arithmetic as written: build it without -ffast-math. docs/determinism.md"
#endif

namespace elastoon {

static_assert(std::numeric_limits<double>::is_iec559, "doubles must be those of IEEE 754");
static_assert(FLT_EVAL_METHOD == 0,
              "doubles must be computed as doubles; on 32-bit x86 build with -msse2 -mfpmath=sse");

namespace {

// pi/2 in three parts of 33, 33 and 53 bits: k * part is exact for |k| < 2^20 in the first two.
constexpr double kHalfPiHigh = 0x1.921fb544p+0;
constexpr double kHalfPiMiddle = 0x1.0b4611a6p-34;
constexpr double kHalfPiLow = 0x1.3198a2e037073p-69;

// Coefficients 1 / n!, of alternating sign. For |x| <= pi/4 the next term is below 2e-18.
double sinSeries(double x) {
    const double x2 = x * x;
    double sum = 1.0 / 355687428096000.0;
    sum = 1.0 / 1307674368000.0 - sum * x2;
    sum = 1.0 / 6227020800.0 - sum * x2;
    sum = 1.0 / 39916800.0 - sum * x2;
    sum = 1.0 / 362880.0 - sum * x2;
    sum = 1.0 / 5040.0 - sum * x2;
    sum = 1.0 / 120.0 - sum * x2;
    sum = 1.0 / 6.0 - sum * x2;
    // The leading x is added last, so that the sum's rounding weighs little; taken from 0, so that -0 stays -0.
    return x + x * (0.0 - x2 * sum);
}

double cosSeries(double x) {
    const double x2 = x * x;
    double sum = 1.0 / 20922789888000.0;
    sum = sum * x2 - 1.0 / 87178291200.0;
    sum = sum * x2 + 1.0 / 479001600.0;
    sum = sum * x2 - 1.0 / 3628800.0;
    sum = sum * x2 + 1.0 / 40320.0;
    sum = sum * x2 - 1.0 / 720.0;
    sum = sum * x2 + 1.0 / 24.0;
    return 1.0 - (0.5 * x2 - x2 * x2 * sum);
}

/// atan for 0 <= x <= 1: the angle is halved twice, then a series.
double atanUnit(double x) {
    const double half = x / (1.0 + std::sqrt(1.0 + x * x));
    const double quarter = half / (1.0 + std::sqrt(1.0 + half * half));
    const double q2 = quarter * quarter;
    double sum = 0.0;
    for (int n = 25; n >= 3; n -= 2) {
        sum = q2 * (1.0 / n - sum);
    }
    return 4.0 * (quarter - quarter * sum);
}

} // namespace

SinCos detSinCos(double angle) {
    const double k = std::floor(angle * (2.0 / kPi) + 0.5);
    const double reduced = ((angle - k * kHalfPiHigh) - k * kHalfPiMiddle) - k * kHalfPiLow;
    const double s = sinSeries(reduced);
    const double c = cosSeries(reduced);
    switch (static_cast<std::int64_t>(k) & 3) {
    case 0:
        return {s, c};
    case 1:
        return {c, -s};
    case 2:
        return {-s, -c};
    default:
        return {-c, s};
    }
}

double detAtan2(double y, double x) {
    const double ax = std::fabs(x);
    const double ay = std::fabs(y);
    if (ax == 0.0 && ay == 0.0) {
        return 0.0;
    }
    const double first = ay <= ax ? atanUnit(ay / ax) : 0.5 * kPi - atanUnit(ax / ay);
    const double upper = x < 0.0 ? kPi - first : first;
    return y < 0.0 ? -upper : upper;
}

double detAcos(double x) {
    const double clamped = x > 1.0 ? 1.0 : (x < -1.0 ? -1.0 : x);
    return detAtan2(std::sqrt((1.0 - clamped) * (1.0 + clamped)), clamped);
}

} // namespace elastoon
