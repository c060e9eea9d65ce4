// See held_bounds.h: the speed bounds are those of the closed forms.
#include "held_bounds.h"

#include "push.h"
#include "slide.h"

#include <algorithm>
#include <cmath>

namespace elastoon {

namespace {

/// Of one half of an impact: how fast it turns (rad/s) and stretches (1/s) at most.
struct HalfRates {
    double turn, stretch;
};

HalfRates ratesOf(const Impact& impact, double length, double span, double omega) {
    if (length <= 0.0) {
        return {0.0, 0.0};
    }
    // The easing's slope is at most 2 in a half that does half of the turn, and 1.5 in one that does all of it.
    const bool alone = impact.curve.t_in <= 0.0 || impact.curve.t_out <= 0.0;
    return {impact.turn_angle * (alone ? 1.5 : 1.0) / length, std::fabs(span) * omega};
}

/// Greatest distance from the centroid with a stretch in between: of each point it is convex in the stretch.
double reachBetween(const Shape& shape, double flattest, double longest) {
    const auto reachAt = [&](double stretch) {
        const double along = stretch * shape.reachAlong();
        return std::sqrt(along * along + shape.reachAcross() * shape.reachAcross() / stretch);
    };
    return std::min(std::max(reachAt(flattest), reachAt(longest)),
                    shape.boundingRadius() * std::max(longest, 1.0 / std::sqrt(flattest)));
}

HeldBounds impactBounds(const Impact& impact, const Shape& shape, double from, double to) {
    const ImpactCurve& curve = impact.curve;
    const double middle = impact.begun + curve.t_in;
    HalfRates most{0.0, 0.0};
    const auto include = [&](const HalfRates& rates) {
        most = {std::max(most.turn, rates.turn), std::max(most.stretch, rates.stretch)};
    };
    if (from < middle) {
        include(ratesOf(impact, curve.t_in, curve.s_in - curve.s_mid, curve.omega_in));
    }
    if (to >= middle) {
        include(ratesOf(impact, curve.t_out, curve.s_out - curve.s_mid, curve.omega_out));
    }
    const double longest = std::max({curve.s_in, curve.s_mid, curve.s_out});
    const double flattest = std::min({curve.s_in, curve.s_mid, curve.s_out});
    HeldBounds bounds;
    bounds.reach = reachBetween(shape, flattest, longest);
    const double across = shape.reachAcross() / std::sqrt(flattest);
    const double widening = 0.5 * across / flattest;
    const double stretching = most.stretch * std::sqrt(shape.reachAlong() * shape.reachAlong() + widening * widening);
    // Twice: about the contact, not the centroid. As much again for the way along the normal; on a solid it may be
    // steep.
    const double own = 2.0 * (most.turn * bounds.reach + stretching) * (impact.surface.solid ? 4.0 : 2.0);
    const MovingFrame& frame = impact.surface.frame;
    const double arm = glm::length(impact.surface.point) + 3.0 * bounds.reach;
    bounds.speed =
        own + glm::length(impact.skims) + glm::length(frame.velocity) + glm::length(frame.angular_velocity) * arm;
    return bounds;
}

HeldBounds restBounds(const Rest& rest, const Shape& shape) {
    HeldBounds bounds;
    bounds.reach = reachBetween(shape, rest.pose.stretch, rest.pose.stretch);
    const MovingFrame& frame = rest.surface.frame;
    bounds.speed = glm::length(frame.velocity) +
                   glm::length(frame.angular_velocity) * (glm::length(rest.pose.position) + bounds.reach);
    return bounds;
}

HeldBounds slideBounds(const Slide& slide, const Shape& shape, double from, double to) {
    const double pull = glm::length(slide.acceleration);
    const double first = glm::length(slideVelocity(slide, from));
    const double last = glm::length(slideVelocity(slide, to));
    // The way turns little, so the least speed is near an end; it may stop only where it does not turn.
    const double speed = std::max(first, last);
    const Vec3 across = slide.acceleration - slide.direction * glm::dot(slide.acceleration, slide.direction);
    const double turning =
        glm::length(across) > 1e-9 * pull ? glm::length(across) / (0.9 * std::min(first, last)) : 0.0;
    const bool eases = from - slide.begun < slide.ease.span;
    const double longest = std::max(slideStretch(slide, speed), eases ? slide.ease.stretch : 1.0);
    const double flattest = eases ? std::min(1.0, slide.ease.stretch) : 1.0;
    const double wide = shape.reachAcross() / std::sqrt(flattest);
    const double easing = eases ? 1.5 / slide.ease.span : 0.0;
    const double stretching = slide.stretch_rate * (slide.max_stretch - 1.0) * pull + easing * (longest - flattest);
    HeldBounds bounds;
    bounds.reach = reachBetween(shape, flattest, longest);
    const double widening = 0.5 * wide / flattest;
    const double form = stretching * std::sqrt(shape.reachAlong() * shape.reachAlong() + widening * widening) +
                        (turning + easing * slide.ease.angle) * bounds.reach;
    const double lifting = slide.surface.solid ? 4.0 : 1.0;
    bounds.speed = (speed + 2.0 * form) * lifting + glm::length(slide.surface.frame.velocity);
    return bounds;
}

HeldBounds ownBounds(const Phase& phase, const Shape& shape, double from, double to) {
    if (const auto* impact = phase.as<Impact>()) {
        return impactBounds(*impact, shape, from, to);
    }
    if (const auto* slide = phase.as<Slide>()) {
        return slideBounds(*slide, shape, from, to);
    }
    return restBounds(phase.get<Rest>(), shape);
}

} // namespace

HeldBounds heldBounds(const Phase& phase, const Shape& shape, double from, double to) {
    HeldBounds bounds = ownBounds(phase, shape, from, to);
    if (!phase.clear_of.empty()) {
        double fastest = bounds.speed;
        for (const KeptClear& kept : phase.clear_of) {
            const MovingFrame& frame = kept.surface.frame;
            fastest = std::max(fastest, bounds.speed + glm::length(frame.velocity) +
                                            glm::length(frame.angular_velocity) *
                                                (glm::length(kept.surface.point) + 3.0 * bounds.reach));
        }
        bounds.speed += pushGain(phase, from) * fastest;
    }
    return bounds;
}

double Drum::lowest(const Vec3& direction) const {
    const double along = glm::dot(direction, normal);
    const double across = glm::length(direction - normal * along);
    return std::min(along * above, -along * below) - across * radius;
}

std::optional<Drum> drumAboutContact(const Phase& phase, double reach, double to) {
    const auto* impact = phase.as<Impact>();
    const auto presses = [](const KeptClear& kept) { return kept.presses; };
    if (impact == nullptr || impact->surface.frame.moves() ||
        std::any_of(phase.clear_of.begin(), phase.clear_of.end(), presses)) {
        return std::nullopt;
    }
    // The centroid is within one reach of the material point that stays over the contact, the rest one further. What
    // lies on the plane goes no higher than two. On a solid the body is let down, till it touches, no further than
    // where that point is on the plane; it may hang over an edge. Where it skims off the face, that point may sink by
    // two more. A push moves it by two (push.h, longestPush), and up from what it meets there.
    const bool skims = impact->skims != Vec3(0.0);
    const double pushed = phase.clear_of.empty() ? 0.0 : 6.0 * reach;
    const double hangs = impact->surface.solid ? (skims ? 4.0 : 2.0) * reach : 0.0;
    const double most = 2.01 * reach + pushed; // and rounding
    return Drum{impact->surface.pointAt(impact->begun), impact->surface.normalAt(impact->begun),
                most + glm::length(impact->skims) * (to - impact->begun), hangs + 0.01 * reach + pushed, most};
}

} // namespace elastoon
