// See room.h. It is looked as often as a wedge needs it, and not at all beside one wall.
#include "room.h"

#include "push.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace elastoon {

namespace {

/// A part of a phase, and how the body is kept clear at its ends.
struct Span {
    double from, to;
    Fit at_from, at_to;
};

/// The last time, to rounding, at which the body of a span fits that fits at its begin and not at its end.
double lastFit(const Phase& phase, const Shape& shape, const Span& span, double nearly) {
    double fits_at = span.from;
    double blocked = span.to;
    while (blocked - fits_at > nearly) {
        const double middle = fits_at + 0.5 * (blocked - fits_at);
        if (middle <= fits_at || middle >= blocked) {
            break;
        }
        (fitted(phase, shape, middle).fits ? fits_at : blocked) = middle;
    }
    return fits_at;
}

/// A move must begin or end at nothing, and be followed by one nearby: else the body would jump. The span between the
/// two sides of a jump, or with no room at its end; none where there is neither.
std::optional<Span> jumpWithin(const Phase& phase, const Shape& shape, Span span) {
    constexpr int kHalvings = 8;
    const double length = shape.length();
    const double moves = 1e-9 * length;
    const double far = 0.02 * length;
    const double jumps = 1e-2 * length;
    const auto step = [](const Fit& a, const Fit& b) { return glm::length(b.shift - a.shift); };
    for (int i = 0; i < kHalvings; ++i) {
        const bool begins = (span.at_from.moved() > moves) != (span.at_to.moved() > moves);
        if (!begins && step(span.at_from, span.at_to) <= (i == 0 ? far : jumps)) {
            return std::nullopt;
        }
        const double middle = span.from + 0.5 * (span.to - span.from);
        const Fit fit = fitted(phase, shape, middle);
        if (!fit.fits) {
            return Span{span.from, middle, span.at_from, fit};
        }
        const bool later = begins ? (fit.moved() > moves) == (span.at_from.moved() > moves)
                                  : step(fit, span.at_to) > step(span.at_from, fit);
        if (later) {
            span.from = middle;
            span.at_from = fit;
        } else {
            span.to = middle;
            span.at_to = fit;
        }
    }
    return step(span.at_from, span.at_to) > jumps ? std::optional(span) : std::nullopt;
}

/// The first part of the time after which the body has no room, or jumps, as far as looking often shows.
std::optional<Span> firstBlocked(const Phase& phase, const Shape& shape, double from, double to) {
    constexpr std::size_t kLooks = 16;
    // What has just come near closes in fastest: also at these shares.
    constexpr std::array<double, 3> kSoon{1.0 / 4096.0, 1.0 / 256.0, 1.0 / 64.0};
    Span span{from, from, fitted(phase, shape, from), {}};
    if (!span.at_from.fits) {
        return span;
    }
    for (std::size_t i = 0; i < kSoon.size() + kLooks; ++i) {
        const double share = i < kSoon.size() ? kSoon[i] : static_cast<double>(i - kSoon.size() + 1) / kLooks;
        span.to = share == 1.0 ? to : from + (to - from) * share;
        span.at_to = fitted(phase, shape, span.to);
        if (!span.at_to.fits) {
            return span;
        }
        if (const auto jump = jumpWithin(phase, shape, span)) {
            return jump;
        }
        span.from = span.to;
        span.at_from = span.at_to;
    }
    return std::nullopt;
}

} // namespace

bool surelyHasRoom(const Phase& phase, const Shape& shape, double to) {
    const auto* impact = phase.as<Impact>();
    if (impact == nullptr || impact->surface.solid || impact->surface.frame.moves() || phase.clear_of.size() != 1) {
        return false;
    }
    const KeptClear& kept = phase.clear_of.front();
    const MovingFrame& frame = impact->surface.frame;
    const Vec3 other = kept.surface.normalAt(to);
    const double up = glm::dot(other, impact->surface.normalAt(to));
    constexpr double kMostUp = 0.95; // one that faces more up or down moves no body along the surface (push.cpp)
    if (kept.surface.frame.moves() || kept.until < to || !(std::fabs(up) < kMostUp)) {
        return false;
    }
    // The body is within two of its radii of the point that stays over the contact, along the surface and up, which is
    // the longest push. A wall that does not lean over the contact asks for no more; one that leans does so less, the
    // further it is.
    const ImpactCurve& curve = impact->curve;
    const auto [flattest, longest] = std::minmax({curve.s_in, curve.s_mid, curve.s_out});
    const double push = std::max(longestPush(shape, longest), longestPush(shape, flattest));
    const double apart = glm::dot(other, impact->surface.pointAt(to) - kept.surface.pointAt(to));
    const double skimmed = glm::dot(other, frame.orientation * impact->skims) * (to - impact->begun);
    return apart + std::min(0.0, skimmed) >= push * std::max(0.0, -up);
}

double blockedAt(const Phase& phase, const Shape& shape, double from, double to) {
    if (surelyHasRoom(phase, shape, to)) {
        return to;
    }
    constexpr int kMostNarrowings = 8;
    const double nearly = 1e-9 * (to - from);
    double end = to;
    // Where it is first found blocked it may have been blocked before: it is looked at again, more closely.
    for (int narrowing = 0; narrowing < kMostNarrowings; ++narrowing) {
        const auto blocked = firstBlocked(phase, shape, from, end);
        if (!blocked) {
            return end;
        }
        end = blocked->at_to.fits ? blocked->from : lastFit(phase, shape, *blocked, nearly);
    }
    return end;
}

double blockedAt(const Phase& phase, const Shape& shape) {
    return blockedAt(phase, shape, phase.start, phase.end);
}

} // namespace elastoon
