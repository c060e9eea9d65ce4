// Stretch by speed, and the impact's curve. Based on: Chenney, Pingel, Iverson, Szymanski, "Simulating Cartoon Style
// Animation", NPAR 2002, sections 3.2 and 3.4. Where it deviates: docs/model.md.
#include "elastoon/model.h"

#include "dmath.h"

#include <algorithm>
#include <cmath>

namespace elastoon {

namespace {

/// A span of s below this is rounding, not a motion.
constexpr double kLeastSpan = 1e-14;
/// A change of form takes this long at least, s.
constexpr double kLeastSettling = 0.02;

/// Least omega_in. Bounded: its own limit at no speed, which also bounds gentle touches of a fast surface.
/// Paper: its contact time has no bound; the speed is taken as a tenth of the rest speed where it is below that.
double leastOmegaIn(const Style& style, const ImpactInput& input, double span) {
    if (style.squash_law == SquashLaw::Bounded) {
        const double limit = input.length * style.stretch_rate * (style.max_stretch - style.min_squash);
        return limit > 0.0 ? style.squash_rate / limit : 0.0;
    }
    return span > kLeastSpan ? style.squash_rate * 0.1 * input.rest_speed / (input.length * span) : 0.0;
}

/// The paper's rule: omega = k_sq speed / (L span).
double omegaOf(const Style& style, double length, double speed, double span) {
    return span > kLeastSpan ? style.squash_rate * speed / (length * span) : 0.0;
}

double quarterPeriod(double omega) {
    return omega > 0.0 ? 0.5 * kPi / omega : 0.0;
}

} // namespace

double stretchShare(const Style& style, double speed) {
    const double scaled = style.stretch_rate * speed;
    return scaled / (scaled + 1.0);
}

double stretchAtSpeed(const Style& style, double speed) {
    const double scaled = style.stretch_rate * speed;
    return (scaled * style.max_stretch + 1.0) / (scaled + 1.0);
}

double deepestSquash(const Style& style, double relative_speed) {
    // Bounded: (s_rel - 1) / (s_max - 1) is the share itself, also where s_max = 1.
    const double depth = style.squash_law == SquashLaw::Bounded
                             ? stretchShare(style, relative_speed)
                             : stretchAtSpeed(style, relative_speed) / style.max_stretch;
    return 1.0 - (1.0 - style.min_squash) * depth;
}

double restSpeed(const Style& style, double length, double gravity_magnitude) {
    constexpr double kLeastShare = 0.05;
    const double derived = std::sqrt(2.0 * gravity_magnitude * 0.02 * length);
    return style.rest_speed == kDerived ? derived : std::max(style.rest_speed, kLeastShare * derived);
}

ImpactCurve impactCurve(const Style& style, const ImpactInput& input) {
    ImpactCurve curve;
    curve.s_in = input.s_in;
    curve.s_out = input.s_out;
    // Without speed nothing drives a squash: the paper's law would ask for one of infinite duration.
    const bool driven = input.speed_in > 0.0;
    curve.s_mid = driven ? std::min(deepestSquash(style, input.speed_in), input.s_in) : input.s_in;

    const double span_in = curve.s_in - curve.s_mid;
    const double span_out = curve.s_out - curve.s_mid;
    const double omega_in =
        std::max(omegaOf(style, input.length, input.speed_in, span_in), leastOmegaIn(style, input, span_in));
    double omega_out = std::max(omegaOf(style, input.length, input.speed_out, span_out), 0.5 * omega_in);
    if (span_in <= kLeastSpan && std::fabs(span_out) > kLeastSpan) {
        // Without a squash that sets a pace, the form still takes time to change, and not for ever.
        omega_out = std::max(omega_out, 0.5 * kPi / settlingTime(style, input.length));
    }
    curve.omega_in = span_in > kLeastSpan || input.turns ? omega_in : 0.0;
    curve.omega_out = std::fabs(span_out) > kLeastSpan || input.turns ? omega_out : 0.0;
    if (input.turns) {
        // A turn takes time, also of a body that does not squash.
        constexpr double kMostOmega = 0.5 * kPi / kLeastSettling;
        curve.omega_in = curve.omega_in > 0.0 ? curve.omega_in : kMostOmega;
        curve.omega_out = curve.omega_out > 0.0 ? curve.omega_out : kMostOmega;
    }
    curve.t_in = quarterPeriod(curve.omega_in);
    curve.t_out = quarterPeriod(curve.omega_out);
    return curve;
}

ImpactCurve skipCurve(const Style& style, const ImpactInput& input) {
    ImpactCurve curve;
    curve.s_in = input.s_in;
    curve.s_out = input.s_out;
    curve.s_mid = input.s_in + std::max(0.0, style.max_stretch - input.s_in) * stretchShare(style, input.speed_in);
    const double slowest = 0.5 * kPi / settlingTime(style, input.length);
    const double omega_in = std::max(omegaOf(style, input.length, input.speed_in, curve.s_mid - curve.s_in), slowest);
    const double omega_out = omegaOf(style, input.length, input.speed_out, std::fabs(curve.s_mid - curve.s_out));
    curve.omega_in = omega_in;
    curve.omega_out = std::max(omega_out, 0.5 * omega_in);
    curve.t_in = quarterPeriod(curve.omega_in);
    curve.t_out = quarterPeriod(curve.omega_out);
    return curve;
}

ImpactCurve inTimes(const ImpactCurve& curve, double factor) {
    ImpactCurve changed = curve;
    changed.t_in *= factor;
    changed.t_out *= factor;
    changed.omega_in /= factor;
    changed.omega_out /= factor;
    return changed;
}

ImpactCurve withTimesOf(const ImpactCurve& curve, const ImpactCurve& other, double share) {
    ImpactCurve mixed = curve;
    mixed.t_in += share * (other.t_in - curve.t_in);
    mixed.t_out += share * (other.t_out - curve.t_out);
    mixed.omega_in = mixed.t_in > 0.0 ? 0.5 * kPi / mixed.t_in : 0.0;
    mixed.omega_out = mixed.t_out > 0.0 ? 0.5 * kPi / mixed.t_out : 0.0;
    return mixed;
}

ImpactCurve withEnd(const ImpactCurve& curve, const Style& style, double length, double speed_out, double s_out) {
    ImpactCurve changed = curve;
    changed.s_out = s_out;
    const double span = std::fabs(s_out - curve.s_mid);
    changed.omega_out = std::max(omegaOf(style, length, speed_out, span), 0.5 * curve.omega_in);
    if (curve.omega_in <= 0.0 && span > kLeastSpan) {
        changed.omega_out = std::max(changed.omega_out, 0.5 * kPi / settlingTime(style, length));
    }
    changed.t_out = quarterPeriod(changed.omega_out);
    return changed;
}

double settlingTime(const Style& style, double length) {
    constexpr double kMost = 1.0;
    const double limit = length * style.stretch_rate * (style.max_stretch - style.min_squash) / style.squash_rate;
    return std::clamp(0.5 * kPi * limit, kLeastSettling, kMost);
}

ImpactCurve recoveryCurve(const Style& style, double length, double stretch) {
    ImpactCurve curve;
    curve.s_in = curve.s_mid = stretch;
    curve.t_out = settlingTime(style, length);
    curve.omega_out = 0.5 * kPi / curve.t_out;
    return curve;
}

double ImpactCurve::at(double t) const {
    if (t <= 0.0 && duration() > 0.0) {
        return s_in;
    }
    if (t >= duration()) {
        return s_out;
    }
    if (t < t_in) {
        return s_in - (s_in - s_mid) * detSinCos(omega_in * t).sin;
    }
    return s_out - (s_out - s_mid) * detSinCos(omega_out * (t - t_in)).cos;
}

double turnShare(const ImpactCurve& curve, ImpactEasing easing, double t) {
    if (t >= curve.duration()) {
        return 1.0;
    }
    if (t <= 0.0) {
        return 0.0;
    }
    // Where one half takes no time, the other does the whole turn: an axis must not jump.
    if (curve.t_in <= 0.0 || curve.t_out <= 0.0) {
        const double x = t / curve.duration();
        return easing == ImpactEasing::Linear ? x : x * x * (3.0 - 2.0 * x);
    }
    const bool squashing = t < curve.t_in;
    const double length = squashing ? curve.t_in : curve.t_out;
    // u runs from the outer end of this half (0) to the deepest squash (1).
    const double u = squashing ? t / length : (curve.duration() - t) / length;
    double half = u;
    if (easing == ImpactEasing::Smooth) {
        // Cubic from (0, slope 0) to (1, slope m): both halves meet at the slower half's rate, so neither overshoots.
        const double m = 2.0 * length / std::max(curve.t_in, curve.t_out);
        half = u * u * ((3.0 - m) + (m - 2.0) * u);
    }
    return squashing ? 0.5 * half : 1.0 - 0.5 * half;
}

} // namespace elastoon
