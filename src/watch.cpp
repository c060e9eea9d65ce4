// Based on: conservative advancement (Mirtich 1996), from both ends of an interval that is halved until it is clear.
// See watch.h.
#include "watch.h"

#include "closest.h"
#include "contact.h"
#include "held_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace elastoon {

namespace {

/// After so many looks, intervals below this share of the time are halved no more.
constexpr int kMostLooks = 4000;
constexpr double kLeastStep = 1.0 / 4096.0;
/// On a solid, and where the body is moved clear of others, how it is moved is seen from its poses, not bounded: each
/// half of an impact is looked at in so many parts at least.
constexpr int kLeastParts = 2;
/// So many are kept at once at most, nearly always.
constexpr std::size_t kUsualLooks = 8;

/// The solid's supporting plane across `normal` (world).
Surface planeAcross(const Watched& watched, const Vec3& normal, double t) {
    Surface surface;
    surface.frame = watched.frame;
    surface.normal = glm::normalize(glm::conjugate(watched.frame.orientationAt(t)) * normal);
    surface.point = watched.solid->vertices()[watched.solid->supportVertex(surface.normal)];
    return surface;
}

} // namespace

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

/// That nothing in the drum comes near to it. Of a solid: by its ball, its height over the drum, its faces if few.
bool isBeyond(const Watched& watched, const Drum& drum, double gap, double t) {
    const Quat world_from_solid = watched.frame.orientationAt(t);
    const Vec3 apart = drum.foot - watched.frame.originAt(t);
    if (!watched.solid) {
        const Vec3 normal = world_from_solid * watched.normal;
        return glm::dot(normal, apart) + drum.lowest(normal) > gap;
    }
    const Shape& solid = *watched.solid;
    const double tall = std::max(drum.above, drum.below);
    if (glm::length(apart) - std::sqrt(drum.radius * drum.radius + tall * tall) > solid.boundingRadius() + gap) {
        return true;
    }
    const Quat solid_from_world = glm::conjugate(world_from_solid);
    const Vec3 up = solid_from_world * drum.normal;
    const Vec3 foot = solid_from_world * apart;
    if (glm::dot(up, solid.vertices()[solid.supportVertex(-up)] - foot) > drum.above + gap) {
        return true;
    }
    constexpr std::size_t kMostFaces = 32;
    const auto& normals = solid.topology().face_normals;
    for (std::size_t i = 0; i < normals.size() && normals.size() <= kMostFaces; ++i) {
        if (glm::dot(normals[i], foot - solid.vertices()[solid.face(i)[0]]) +
                drum.lowest(world_from_solid * normals[i]) >
            gap) {
            return true;
        }
    }
    return false;
}

/// That nothing within `reach` of the solid that an impact is on comes near to it.
bool isBeyondSolid(const Watched& watched, const Surface& surface, double reach, double t) {
    const Vec3 apart = surface.frame.originAt(t) - watched.frame.originAt(t);
    if (watched.solid) {
        return glm::length(apart) > watched.solid->boundingRadius() + surface.solid->boundingRadius() + reach;
    }
    const Vec3 normal = watched.frame.orientationAt(t) * watched.normal;
    const Vec3 down = glm::conjugate(surface.frame.orientationAt(t)) * -normal;
    const double hangs = glm::dot(down, surface.solid->vertices()[surface.solid->supportVertex(down)]);
    return glm::dot(normal, apart) - hangs > reach;
}

/// How far an impact's body on something that stands can go shows that it does not come near.
bool staysAway(const Phase& phase, const Watched& watched, double reach, double from, double to, double gap) {
    const auto drum = drumAboutContact(phase, reach, to);
    if (watched.frame.moves() || !drum) {
        return false;
    }
    if (isBeyond(watched, *drum, gap, from)) {
        return true;
    }
    // It touches the solid, unless it is pushed off something else.
    const Surface& surface = phase.get<Impact>().surface;
    return surface.solid && phase.clear_of.empty() && isBeyondSolid(watched, surface, 2.01 * reach + gap, from);
}

/// A moment that has been looked at, and where in `gaps_` it is kept how far each of those that are watched was.
struct Look {
    double t = 0.0;
    Pose pose;
    double share = 0.0; ///< of an impact's turn
    std::size_t gaps = 0;
};

/// Watches all at once: what costs is the pose, so it is looked at together. Each is looked at when its own distance
/// asks for it, whoever else is watched.
class Lookout {
public:
    Lookout(const Phase& phase, const Shape& shape, double from, double to, double gap);
    void watch(const Watched& watched);
    std::optional<Near> run();

private:
    struct Watch {
        const Watched* watched;
        double begin; ///< it is not met before
        double along_normal; ///< cosine between its normal and the impact's surface's; 1 where there is none
        bool lifted_off; ///< what lifts the impact's body off its surface takes it further from this one
        ClosestSeed seed;
    };
    /// A part of `open_`: those that are not known to stay away.
    struct Group {
        std::size_t begin, end;
    };

    [[nodiscard]] Look lookAt(double t, Group group);
    [[nodiscard]] double gapOf(Watch& watch, const Pose& pose, double t) const;
    [[nodiscard]] double wayAboutContact(double turn, double stretch_a, double stretch_b) const;
    [[nodiscard]] double ownWay(const Look& a, const Look& b, double along_normal) const;
    [[nodiscard]] double wayToEnd(const Look& look, double along_normal, bool bounded) const;
    [[nodiscard]] double closing(const Watch& watch, const Pose& pose, double gap, double span) const;
    [[nodiscard]] bool isAwayForGood(const Watch& watch, const Look& look, double gap) const;
    [[nodiscard]] bool isClear(const Watch& watch, const Look& a, double gap_a, const Look& b, double gap_b) const;
    [[nodiscard]] std::optional<Near> between(const Look& a, const Look& b, Group group);
    [[nodiscard]] std::optional<Near> beginningAt(double begin);
    [[nodiscard]] std::optional<Near> nearAt(const Look& look, double apart, Group group);
    [[nodiscard]] double shareAt(double t) const {
        return impact_ != nullptr ? turnShare(impact_->curve, impact_->easing, t - impact_->begun) : 0.0;
    }

    const Phase& phase_;
    const Impact* impact_;
    const Shape& shape_;
    double from_, to_, gap_;
    double turns_at_; ///< before it `bounds_` hold, from then on `later_bounds_`
    HeldBounds bounds_, later_bounds_;
    double reach_ = 0.0;
    bool steep_ = false; ///< how the body is moved along the normal, or clear of others, is not bounded
    int looks_ = 0;
    std::vector<Watch> watches_;
    std::vector<double> gaps_;
    std::vector<std::uint32_t> open_;
};

Lookout::Lookout(const Phase& phase, const Shape& shape, double from, double to, double gap)
    : phase_(phase), impact_(phase.as<Impact>()), shape_(shape), from_(from), to_(to), gap_(gap) {
    steep_ = impact_ != nullptr && (impact_->surface.solid || !phase.clear_of.empty());
    // A half that takes hardly any time is fast: its bounds are its own.
    const double middle = impact_ != nullptr ? impact_->begun + impact_->curve.t_in : from;
    turns_at_ = middle > from && middle < to ? middle : to;
    bounds_ = heldBounds(phase, shape, from, std::nextafter(turns_at_, from));
    later_bounds_ = turns_at_ < to ? heldBounds(phase, shape, turns_at_, to) : bounds_;
    reach_ = std::max(bounds_.reach, later_bounds_.reach);
}

void Lookout::watch(const Watched& watched) {
    // Before it began to move as it does, it was met or missed otherwise.
    const double begin = std::max(from_, watched.frame.start);
    if (begin > to_ || staysAway(phase_, watched, reach_, from_, to_, gap_)) {
        return;
    }
    const bool plane_stands = impact_ != nullptr && !watched.solid && !watched.frame.moves();
    const double cosine =
        plane_stands ? glm::dot(watched.frame.orientation * watched.normal, impact_->surface.normalAt(begin)) : -1.0;
    const bool lifted_off = cosine >= 0.0 && !impact_->surface.frame.moves() && phase_.clear_of.empty();
    watches_.push_back({&watched, begin, std::fabs(cosine), lifted_off, {}});
}

double Lookout::gapOf(Watch& watch, const Pose& pose, double t) const {
    const Watched& watched = *watch.watched;
    if (!watched.solid) {
        const Vec3 normal = watched.frame.orientationAt(t) * watched.normal;
        return glm::dot(normal, pose.position - watched.frame.originAt(t)) - reachTowards(shape_, pose, -normal);
    }
    const Closest closest = closestPoints(
        {&shape_, linearOf(pose), pose.position},
        {watched.solid.get(), glm::mat3_cast(watched.frame.orientationAt(t)), watched.frame.originAt(t)}, watch.seed);
    return closest.overlap ? 0.0 : closest.distance;
}

Look Lookout::lookAt(double t, Group group) {
    Look look{t, poseAt(phase_, shape_, t), shareAt(t), gaps_.size()};
    gaps_.resize(gaps_.size() + watches_.size());
    for (std::size_t k = group.begin; k < group.end; ++k) {
        gaps_[look.gaps + open_[k]] = gapOf(watches_[open_[k]], look.pose, t);
    }
    ++looks_;
    return look;
}

/// How far the points of an impact's body go in the surface's frame by a turn and a change of form. Twice: about the
/// contact, not the centroid.
double Lookout::wayAboutContact(double turn, double stretch_a, double stretch_b) const {
    const double along = (stretch_b - stretch_a) * shape_.reachAlong();
    const double across = (1.0 / std::sqrt(stretch_b) - 1.0 / std::sqrt(stretch_a)) * shape_.reachAcross();
    return 2.0 * (turn * reach_ + std::sqrt(along * along + across * across));
}

/// Greatest way that a point of the body makes between two looks, within one half of an impact.
double Lookout::ownWay(const Look& a, const Look& b, double along_normal) const {
    const double span = b.t - a.t;
    if (impact_ == nullptr) {
        return bounds_.speed * span;
    }
    const MovingFrame& frame = impact_->surface.frame;
    const double arm = glm::length(impact_->surface.point) + (phase_.clear_of.empty() ? 3.0 : 6.0) * reach_;
    const double carried = glm::length(frame.velocity) + glm::length(frame.angular_velocity) * arm;
    const double turn = impact_->turn_angle * std::fabs(b.share - a.share) / (1.0 - impact_->turn_from);
    const double about = wayAboutContact(turn, a.pose.stretch, b.pose.stretch);
    // As much again for the way along the normal.
    const double moved = steep_ ? 2.0 * glm::length(b.pose.position - a.pose.position) : about * along_normal;
    return about + moved + (glm::length(impact_->skims) + carried) * span;
}

/// Likewise from a look to the end, bounded without another look: by the way about the contact and along the normal
/// where that is bounded, else by the greatest speed.
double Lookout::wayToEnd(const Look& look, double along_normal, bool bounded) const {
    if (impact_ == nullptr || !bounded || impact_->surface.frame.moves()) {
        const double first = std::max(0.0, turns_at_ - look.t);
        return bounds_.speed * first + later_bounds_.speed * (to_ - look.t - first);
    }
    const auto stretchAt = [&](double t) { return impact_->curve.at(t - impact_->begun); };
    const double scale = impact_->turn_angle / (1.0 - impact_->turn_from);
    double way = glm::length(impact_->skims) * (to_ - look.t);
    double share = look.share;
    double stretch = look.pose.stretch;
    for (const double t : {turns_at_, to_}) {
        if (t > look.t) {
            const double next = stretchAt(t);
            way += wayAboutContact(scale * std::fabs(shareAt(t) - share), stretch, next) * (1.0 + along_normal);
            share = shareAt(t);
            stretch = next;
        }
    }
    return way;
}

/// How fast the obstacle comes at most, within `span` s, m/s.
double Lookout::closing(const Watch& watch, const Pose& pose, double gap, double span) const {
    const MovingFrame& frame = watch.watched->frame;
    const double spin = glm::length(frame.angular_velocity);
    const double arm = glm::length(pose.position - frame.origin) + glm::length(frame.velocity) * (to_ - frame.start) +
                       reach_ + (watch.watched->solid ? 0.0 : gap) +
                       span * std::max(bounds_.speed, later_bounds_.speed);
    return glm::length(frame.velocity) + (spin > 0.0 ? spin * arm : 0.0);
}

bool Lookout::isAwayForGood(const Watch& watch, const Look& look, double gap) const {
    const double span = to_ - look.t;
    // The contact stays on the surface, so the body is only ever lifted from how it lies at the touch.
    const bool lifted = watch.lifted_off && look.t <= impact_->begun;
    const double way = wayToEnd(look, lifted ? 0.0 : watch.along_normal, lifted || !steep_);
    return (lifted || !steep_ || gap > reach_) && gap - way - closing(watch, look.pose, gap, span) * span > 0.5 * gap_;
}

/// From both ends: what comes nearer than half of the gap goes further in between than it can.
bool Lookout::isClear(const Watch& watch, const Look& a, double gap_a, const Look& b, double gap_b) const {
    const double span = b.t - a.t;
    const double way = ownWay(a, b, watch.along_normal) + closing(watch, a.pose, std::max(gap_a, gap_b), span) * span;
    return gap_a + gap_b - way > gap_;
}

/// At the very end only what is touched counts: what comes after meets the rest.
std::optional<Near> Lookout::nearAt(const Look& look, double apart, Group group) {
    const bool last = look.t >= to_ && look.t > from_;
    for (std::size_t k = group.begin; k < group.end; ++k) {
        const double gap = gaps_[look.gaps + open_[k]];
        if (last ? gap > 0.0 : gap > gap_) {
            continue;
        }
        const Watched& watched = *watches_[open_[k]].watched;
        if (gap <= 0.0 && look.t > apart) {
            return Near{stepBack(phase_, shape_, watched, apart, look.t, gap_), &watched};
        }
        ClosestSeed cold;
        return Near{{look.t, distanceTo(watched, shape_, look.pose, look.t, cold).plane}, &watched};
    }
    return std::nullopt;
}

/// The first in (a, b]; at `a` all of the group are apart.
std::optional<Near> Lookout::between(const Look& a, const Look& b, Group group) {
    const std::size_t first = open_.size();
    for (std::size_t k = group.begin; k < group.end; ++k) {
        const std::uint32_t i = open_[k];
        if (!isClear(watches_[i], a, gaps_[a.gaps + i], b, gaps_[b.gaps + i])) {
            open_.push_back(i);
        }
    }
    const Group open{first, open_.size()};
    const double middle = a.t + 0.5 * (b.t - a.t);
    const bool fine = looks_ > kMostLooks && b.t - a.t <= kLeastStep * (to_ - from_);
    std::optional<Near> found;
    if (open.begin < open.end && middle > a.t && middle < b.t && !fine) {
        const Look look = lookAt(middle, open);
        found = between(a, look, open);
        if (!found) {
            found = between(look, b, open);
        }
        gaps_.resize(look.gaps);
    }
    open_.resize(first);
    return found ? found : nearAt(b, a.t, group);
}

/// The first of those that are met from `begin` on.
std::optional<Near> Lookout::beginningAt(double begin) {
    open_.clear();
    gaps_.clear();
    gaps_.reserve(kUsualLooks * watches_.size());
    for (std::uint32_t i = 0; i < watches_.size(); ++i) {
        if (watches_[i].begin == begin) {
            open_.push_back(i);
        }
    }
    Look look = lookAt(begin, {0, open_.size()});
    if (auto found = nearAt(look, begin, {0, open_.size()}); found || begin >= to_) {
        return found;
    }
    std::erase_if(open_, [&](std::uint32_t i) { return isAwayForGood(watches_[i], look, gaps_[look.gaps + i]); });
    const Group group{0, open_.size()};
    std::array<double, 2 * kLeastParts> ends{};
    std::size_t count = 0;
    const int parts = steep_ ? kLeastParts : 1;
    for (const auto& [half_begin, half_end] :
         {std::pair(begin, turns_at_), std::pair(std::max(begin, turns_at_), to_)}) {
        for (int part = 1; half_begin < half_end && part <= parts; ++part) {
            ends[count++] = part == parts ? half_end : half_begin + (half_end - half_begin) * part / parts;
        }
    }
    for (std::size_t i = 0; i < count && group.begin < group.end; ++i) {
        const Look next = lookAt(ends[i], group);
        if (auto found = between(look, next, group)) {
            return found;
        }
        look = next;
    }
    return std::nullopt;
}

std::optional<Near> Lookout::run() {
    std::optional<Near> first;
    for (const Watch& watch : watches_) {
        // Most begin at once; of those that begin together the first one looks for all.
        const auto with = std::find_if(watches_.begin(), watches_.end(),
                                       [&](const Watch& other) { return other.begin == watch.begin; });
        if (&*with != &watch) {
            continue;
        }
        const auto found = beginningAt(watch.begin);
        if (found && (!first || found->touch.time < first->touch.time)) {
            first = found;
        }
    }
    return first;
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
