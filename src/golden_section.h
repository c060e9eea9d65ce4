// Where a function with one peak is best, by golden section.
#pragma once

namespace elastoon {

/// The best of at(x) for x between low and high, of what is looked at in so many rounds; isBetter(a, b) compares two.
template <class At, class IsBetter>
[[nodiscard]] auto goldenSection(double low, double high, int rounds, At&& at, IsBetter&& isBetter) {
    constexpr double kShare = 0.6180339887498949;
    double first = high - kShare * (high - low);
    double second = low + kShare * (high - low);
    auto lower = at(first);
    auto upper = at(second);
    for (int i = 0; i < rounds; ++i) {
        if (isBetter(upper, lower)) {
            low = first;
            first = second;
            lower = upper;
            second = low + kShare * (high - low);
            upper = at(second);
        } else {
            high = second;
            second = first;
            upper = lower;
            first = high - kShare * (high - low);
            lower = at(first);
        }
    }
    return isBetter(upper, lower) ? upper : lower;
}

} // namespace elastoon
