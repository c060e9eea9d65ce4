// What detSinCos() is made of, for loops that work out many at once. Power series on reduced arguments: their
// remainders are below 2e-18 there.
#pragma once

namespace elastoon {

// pi/2 in three parts of 33, 33 and 53 bits: k * part is exact for |k| < 2^20 in the first two.
inline constexpr double kHalfPiHigh = 0x1.921fb544p+0;
inline constexpr double kHalfPiMiddle = 0x1.0b4611a6p-34;
inline constexpr double kHalfPiLow = 0x1.3198a2e037073p-69;

// Coefficients 1 / n!, of alternating sign. For |x| <= pi/4 the next term is below 2e-18.
inline double sinSeries(double x) {
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

inline double cosSeries(double x) {
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

} // namespace elastoon
