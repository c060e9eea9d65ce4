// See dmath.h.
#include "dmath.h"

#include "dmath_series.h"

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
