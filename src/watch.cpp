// Based on: conservative advancement (Mirtich 1996); the speed bounds are those of the impact's closed form. See
// watch.h.
#include "watch.h"

#include "closest.h"
#include "contact.h"
#include "push.h"
#include "slide.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace elastoon {

namespace {

/// After so many looks, not all of them as far apart as is safe, but this share of the time at least.
constexpr int kMostLooks = 20000;
constexpr double kLeastStep = 1.0 / 4096.0;

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
    const double along = longest * shape.reachAlong();
    const double across = shape.reachAcross() / std::sqrt(flattest);
    HeldBounds bounds;
    bounds.reach = std::sqrt(along * along + across * across);
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
    const double along = rest.pose.stretch * shape.reachAlong();
    const double across = shape.reachAcross() / std::sqrt(rest.pose.stretch);
    bounds.reach = std::sqrt(along * along + across * across);
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
    const double along = longest * shape.reachAlong();
    const double wide = shape.reachAcross() / std::sqrt(flattest);
    const double easing = eases ? 1.5 / slide.ease.span : 0.0;
    const double stretching = slide.stretch_rate * (slide.max_stretch - 1.0) * pull + easing * (longest - flattest);
    HeldBounds bounds;
    bounds.reach = std::sqrt(along * along + wide * wide);
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

/// The solid's supporting plane across `normal` (world).
Surface planeAcross(const Watched& watched, const Vec3& normal, double t) {
    Surface surface;
    surface.frame = watched.frame;
    surface.normal = glm::normalize(glm::conjugate(watched.frame.orientationAt(t)) * normal);
    surface.point = watched.solid->vertices()[watched.solid->supportVertex(surface.normal)];
    return surface;
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

double ballAboutContact(const Phase& phase, double reach, double to) {
    const auto* impact = phase.as<Impact>();
    const auto presses = [](const KeptClear& kept) { return kept.presses; };
    if (impact == nullptr || impact->surface.frame.moves() ||
        std::any_of(phase.clear_of.begin(), phase.clear_of.end(), presses)) {
        return std::numeric_limits<double>::infinity();
    }
    // The centroid is within one reach of the contact along the surface and across it, so within 1.42; and one on. Over
    // a solid's edge it may be two lower. A push moves it by two (push.cpp, kMostPush), and up from what it meets
    // there.
    const double pushed = phase.clear_of.empty() ? 0.0 : 6.0;
    return ((impact->surface.solid ? 4.5 : 2.5) + pushed) * reach + glm::length(impact->skims) * (to - impact->begun);
}

Distance distanceTo(const Watched& watched, const Shape& shape, const Pose& pose, double t, ClosestSeed& seed) {
    if (!watched.solid) {
        const Surface plane{watched.frame, Vec3(0.0), watched.normal, nullptr};
        return {gapTo(plane, shape, pose, t), plane};
    }
    const PosedShape body{&shape, linearOf(pose), pose.position};
    const PosedShape solid{watched.solid.get(), glm::mat3_cast(watched.frame.orientationAt(t)),
                           watched.frame.originAt(t)};
    const Closest closest = closestPoints(body, solid, seed);
    if (!closest.overlap) {
        return {closest.distance, planeAcross(watched, closest.normal, t)};
    }
    const Vec3 between = pose.position - solid.position;
    const double length = glm::length(between);
    Surface hint = planeAcross(watched, length > 0.0 ? between / length : Vec3(0.0, 1.0, 0.0), t);
    hint.solid = watched.solid;
    return {0.0, separatingPlane(hint, shape, pose, t)};
}

namespace {

/// On a solid the way along the normal may be steeper than the bounds allow for: an impact is looked at this often at
/// least, and a touch that was passed is looked for backwards.
constexpr double kLeastLooks = 64.0;

/// The first time, to rounding, in (apart, touching] at which the obstacle is within `gap`; at `apart` it is not.
Touch stepBack(const Phase& phase, const Shape& shape, const Watched& watched, double apart, double touching,
               double gap) {
    ClosestSeed seed;
    for (;;) {
        const double middle = apart + 0.5 * (touching - apart);
        const bool done = middle <= apart || middle >= touching;
        const double t = done ? apart : middle;
        const Distance distance = distanceTo(watched, shape, poseAt(phase, shape, t), t, seed);
        if (done || (distance.gap > 0.0 && distance.gap <= gap)) {
            return {t, distance.plane};
        }
        (distance.gap > gap ? apart : touching) = middle;
    }
}

/// That nothing of the impact's body, which goes no further than `ball` from the contact, comes near to it.
bool isBeyond(const Watched& watched, const Vec3& contact, double ball, double t) {
    const Vec3 apart = contact - watched.frame.originAt(t);
    return watched.solid ? glm::length(apart) > watched.solid->boundingRadius() + ball
                         : glm::dot(watched.frame.orientationAt(t) * watched.normal, apart) > ball;
}

/// The same of a body that always touches the solid.
bool isBeyondSolid(const Watched& watched, const Surface& surface, double ball, double t) {
    const Vec3 center = surface.frame.originAt(t);
    if (watched.solid) {
        return isBeyond(watched, center, surface.solid->boundingRadius() + ball, t);
    }
    const Vec3 normal = watched.frame.orientationAt(t) * watched.normal;
    const Vec3 down = glm::conjugate(surface.frame.orientationAt(t)) * -normal;
    const double reach = glm::dot(down, surface.solid->vertices()[surface.solid->supportVertex(down)]);
    return glm::dot(normal, center - watched.frame.originAt(t)) - reach > ball;
}

/// The balls that an impact on something that stands cannot leave show it.
bool staysAway(const Phase& phase, const Watched& watched, double reach, double from, double to, double gap) {
    const double ball = ballAboutContact(phase, reach, to) + gap;
    if (watched.frame.moves() || ball == std::numeric_limits<double>::infinity()) {
        return false;
    }
    const Surface& surface = phase.get<Impact>().surface;
    return isBeyond(watched, surface.pointAt(from), ball, from) ||
           (surface.solid && isBeyondSolid(watched, surface, 2.0 * reach + gap, from));
}

/// How far the points of an impact's body go, in the surface's frame, before any push: from the turn and the change of
/// form themselves, which their rates' bounds exceed.
class ImpactWay {
public:
    ImpactWay(const Impact& impact, const Shape& shape, double reach) : impact_(impact), shape_(shape), reach_(reach) {}

    /// Times are counted from here, within one half of the impact.
    void startAt(double t) {
        share_ = shareAt(t);
        stretch_ = impact_.curve.at(t - impact_.begun);
    }
    /// Greatest way of a point from the start to time t, and of that the most that moving along the normal has in it.
    [[nodiscard]] double to(double t, double along_normal) const {
        const double turn = impact_.turn_angle * std::fabs(shareAt(t) - share_) / (1.0 - impact_.turn_from);
        const double stretch = impact_.curve.at(t - impact_.begun);
        const double along = (stretch - stretch_) * shape_.reachAlong();
        const double across = (1.0 / std::sqrt(stretch) - 1.0 / std::sqrt(stretch_)) * shape_.reachAcross();
        // Twice: about the contact, not the centroid. As much again for the way along the normal; on a solid it may be
        // steep.
        const double about_contact = 2.0 * (turn * reach_ + std::sqrt(along * along + across * across));
        return about_contact * (1.0 + along_normal * (impact_.surface.solid ? 3.0 : 1.0));
    }

private:
    [[nodiscard]] double shareAt(double t) const { return turnShare(impact_.curve, impact_.easing, t - impact_.begun); }

    const Impact& impact_;
    const Shape& shape_;
    double reach_;
    double share_ = 0.0;
    double stretch_ = 1.0;
};

/// One of those that are watched.
struct Watch {
    const Watched* watched;
    double clear_until; ///< it is not met before
    double apart; ///< last time at which it was seen apart
    ClosestSeed seed;
};

/// Watches all at once: what costs is the pose, so it is looked at together where that can be.
class Lookout {
public:
    Lookout(const Phase& phase, const Shape& shape, double from, double to, double gap)
        : phase_(phase),
          shape_(shape),
          from_(from),
          to_(to),
          gap_(gap),
          pose_(poseAt(phase, shape, from)),
          posed_at_(from) {
        const auto* impact = phase.as<Impact>();
        grid_ = impact != nullptr ? impact->curve.duration() / kLeastLooks : (to - from) / kLeastLooks;
        steep_ = impact != nullptr && impact->surface.solid;
        // A half that takes hardly any time is fast: its bounds are its own.
        const double middle = impact != nullptr ? impact->begun + impact->curve.t_in : from;
        turns_at_ = middle > from && middle < to ? middle : to;
        bounds_ = heldBounds(phase, shape, from, std::nextafter(turns_at_, from));
        later_bounds_ = turns_at_ < to ? heldBounds(phase, shape, turns_at_, to) : bounds_;
        reach_ = std::max(bounds_.reach, later_bounds_.reach);
    }

    void watch(const Watched& watched) {
        // Before it began to move as it does, it was met or missed otherwise.
        const double begin = std::max(from_, watched.frame.start);
        if (begin <= to_ && !staysAway(phase_, watched, reach_, from_, to_, gap_)) {
            watches_.push_back({&watched, begin, begin, {}});
        }
    }
    std::optional<Near> run();

private:
    [[nodiscard]] const Pose& poseOf(double t) {
        if (t != posed_at_) {
            pose_ = poseAt(phase_, shape_, t);
            posed_at_ = t;
        }
        return pose_;
    }
    [[nodiscard]] Touch met(const Watch& watch, double apart, double t, const Distance& distance) const {
        return distance.gap <= 0.0 && t > apart ? stepBack(phase_, shape_, *watch.watched, apart, t, gap_)
                                                : Touch{t, distance.plane};
    }
    [[nodiscard]] double reachedBy(const Watched& watched, double t, double until, double allowed, double speed) const;
    [[nodiscard]] double nextLook(const Watched& watched, const Pose& pose, double t, double distance) const;

    const Phase& phase_;
    const Shape& shape_;
    double from_, to_, gap_;
    double turns_at_ = 0.0; ///< before it `bounds_` hold, from then on `later_bounds_`
    HeldBounds bounds_, later_bounds_;
    double reach_ = 0.0;
    double grid_ = 0.0;
    int looks_ = 0;
    bool steep_ = false; ///< the bounds may be passed
    Pose pose_;
    double posed_at_;
    std::vector<Watch> watches_;
};

/// Until when an impact's body that is not pushed goes no further than `allowed`, besides what goes at `speed`; a time
/// up to `until`, in the half in which t is.
double Lookout::reachedBy(const Watched& watched, double t, double until, double allowed, double speed) const {
    const auto& impact = phase_.get<Impact>();
    ImpactWay way(impact, shape_, reach_);
    way.startAt(t);
    const bool plane_stands = !watched.solid && watched.frame.angular_velocity == Vec3(0.0);
    const double along_normal =
        plane_stands ? std::fabs(glm::dot(watched.frame.orientation * watched.normal, impact.surface.normalAt(t)))
                     : 1.0;
    constexpr int kMostTries = 5;
    double next = until;
    for (int i = 0; i < kMostTries; ++i) {
        const double need = way.to(next, along_normal) + speed * (next - t);
        if (need <= allowed) {
            return next;
        }
        next = t + (next - t) * 0.9 * allowed / need;
    }
    return t;
}

double Lookout::nextLook(const Watched& watched, const Pose& pose, double t, double distance) const {
    const double until = t < turns_at_ ? turns_at_ : to_;
    const HeldBounds& bounds = t < turns_at_ ? bounds_ : later_bounds_;
    const double arm = glm::length(pose.position - watched.frame.originAt(t)) + bounds.reach +
                       (watched.solid ? 0.0 : distance) + (until - t) * bounds.speed;
    const double closing = glm::length(watched.frame.velocity) + glm::length(watched.frame.angular_velocity) * arm;
    const double allowed = distance - 0.5 * gap_;
    double next = t + allowed / (bounds.speed + closing);
    const auto* impact = phase_.as<Impact>();
    if (impact != nullptr && phase_.clear_of.empty() && !impact->surface.frame.moves()) {
        next = std::max(next, reachedBy(watched, t, until, allowed, closing + glm::length(impact->skims)));
    }
    if (steep_ && distance < bounds.reach) {
        next = std::min(next, t + grid_);
    }
    if (looks_ > kMostLooks) {
        next = std::max(next, t + (to_ - from_) * kLeastStep);
    }
    if (next >= until) {
        return until;
    }
    // Onto the common grid, where it does not come to a stop.
    const double on_grid = from_ + grid_ * std::floor((next - from_) / grid_);
    return on_grid > t ? on_grid : std::max(next, std::nextafter(t, until));
}

std::optional<Near> Lookout::run() {
    for (; !watches_.empty(); ++looks_) {
        const auto next = std::min_element(watches_.begin(), watches_.end(), [](const Watch& a, const Watch& b) {
            return a.clear_until < b.clear_until;
        });
        Watch& watch = *next;
        const double t = std::min(watch.clear_until, to_);
        const Pose& pose = poseOf(t);
        const Distance distance = distanceTo(*watch.watched, shape_, pose, t, watch.seed);
        const bool last = t >= to_ && t > from_;
        if (last ? distance.gap <= 0.0 : distance.gap <= gap_) {
            return Near{met(watch, watch.apart, t, distance), watch.watched};
        }
        if (t >= to_) {
            watches_.erase(next);
            continue;
        }
        watch.apart = t;
        watch.clear_until = nextLook(*watch.watched, pose, t, distance.gap);
    }
    return std::nullopt;
}

} // namespace

std::optional<Near> firstNear(const Phase& phase, const Shape& shape, std::span<const Watched> all, double from,
                              double to, double gap) {
    if (all.empty()) {
        return std::nullopt;
    }
    Lookout lookout(phase, shape, from, to, gap);
    for (const Watched& watched : all) {
        lookout.watch(watched);
    }
    return lookout.run();
}

} // namespace elastoon
