// Based on: Chenney et al., NPAR 2002, section 3.6. The shift is the shortest one out of half spaces, found among the
// few sets of them that can hold it. See push.h.
#include "push.h"

#include "contact.h"
#include "edge_contact.h"
#include "flight.h"
#include "impact.h"
#include "squeeze.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <utility>
#include <vector>

namespace elastoon {

namespace {

/// Depths up to this share of the length are rounding.
constexpr double kRounding = 1e-12;
/// A way along the surface shorter than this (of a unit normal) is none: a wedge under 15 degrees lets nothing out.
constexpr double kLeastWay = 0.25;
constexpr std::size_t kMostBarriers = 16;
/// Of looking for a shift that clears all and changes no more.
constexpr int kMostRounds = 24;
/// What may be left of a depth after that many, as a share of the length.
constexpr double kGoodEnough = 1e-7;

/// Shortest d with d . a = p, d . b = q; none where the two are all but parallel.
std::optional<Vec3> onTwo(const Vec3& a, double p, const Vec3& b, double q) {
    const double aa = glm::dot(a, a);
    const double bb = glm::dot(b, b);
    const double ab = glm::dot(a, b);
    const double det = aa * bb - ab * ab;
    if (!(det > 1e-6 * aa * bb)) {
        return std::nullopt;
    }
    return a * ((p * bb - q * ab) / det) + b * ((q * aa - p * ab) / det);
}

std::optional<Vec3> onThree(const Barrier& a, const Barrier& b, const Barrier& c) {
    const double det = glm::dot(a.way, glm::cross(b.way, c.way));
    if (!(std::fabs(det) > 1e-3 * glm::length(a.way) * glm::length(b.way) * glm::length(c.way))) {
        return std::nullopt;
    }
    return (glm::cross(b.way, c.way) * -a.gap + glm::cross(c.way, a.way) * -b.gap + glm::cross(a.way, b.way) * -c.gap) /
           det;
}

/// Keeps the shortest of the shifts that do.
class Shortest {
public:
    Shortest(std::span<const Barrier> barriers, double slack) : barriers_(barriers), slack_(slack) {}

    /// A shift that lies on these barriers; rounding may have put it a little beyond them.
    void consider(const std::optional<Vec3>& shift, std::initializer_list<std::size_t> on) {
        if (!shift) {
            return;
        }
        const double squared = glm::dot(*shift, *shift);
        if ((!best_ || squared < squared_) && clears(*shift, on)) {
            best_ = shift;
            squared_ = squared;
        }
    }
    [[nodiscard]] const std::optional<Vec3>& best() const { return best_; }

private:
    [[nodiscard]] bool clears(const Vec3& shift, std::initializer_list<std::size_t> on) const {
        for (std::size_t i = 0; i < barriers_.size(); ++i) {
            const bool given = std::find(on.begin(), on.end(), i) != on.end();
            if (!given && !(barriers_[i].gap + glm::dot(shift, barriers_[i].way) >= -slack_)) {
                return false;
            }
        }
        return true;
    }

    std::span<const Barrier> barriers_;
    double slack_;
    std::optional<Vec3> best_;
    double squared_ = 0.0;
};

/// The way out of the second surface along the first; zero where there is none.
Vec3 wayAlong(const Vec3& normal, const Vec3& other) {
    const Vec3 way = other - normal * glm::dot(normal, other);
    return glm::dot(way, way) >= kLeastWay * kLeastWay ? way : Vec3(0.0);
}

/// All but the same surface once more: what is out of it is lifted off the first.
bool continues(const Vec3& normal, const Vec3& other) {
    return glm::dot(normal, other) > 0.0 && wayAlong(normal, other) == Vec3(0.0);
}

/// How high over its own place the primary surface holds the body, and how that changes along the surface.
struct Footing {
    double lift = 0.0;
    Vec3 slope{0.0};
    bool steeper = false; ///< than the slope says: it stands against a wall
};

/// None where the body has nothing of the solid under it.
std::optional<Footing> footingOf(const Surface& primary, const Shape& shape, const Pose& pose, double t) {
    if (!primary.solid) {
        return Footing{};
    }
    const Quat orientation = primary.frame.orientationAt(t);
    const Pose in_frame{primary.frame.frameFromWorld(t, pose.position), glm::conjugate(orientation) * pose.orientation,
                        pose.stretch};
    if (const auto lift = liftOntoFace(primary, shape, in_frame)) {
        return Footing{*lift, Vec3(0.0)};
    }
    const auto contact = contactOffFace(primary, shape, in_frame);
    if (!contact) {
        return std::nullopt;
    }
    constexpr double kSteepest = 0.05;
    const double steep = glm::dot(contact->normal, primary.normal);
    const Vec3 across = contact->normal - primary.normal * steep;
    return Footing{contact->shift, orientation * (across / -std::max(steep, kSteepest)), steep < kSteepest};
}

/// Moves a pose, along the primary surface and up from it, out of what it is to be kept clear of: Newton's method on
/// the whole shift.
class Mover {
public:
    Mover(const Phase& phase, const Shape& shape, double t, const Pose& own)
        : phase_(phase),
          shape_(shape),
          t_(t),
          own_(own),
          pose_(own),
          primary_(surfaceOf(phase)),
          normal_(primary_ != nullptr ? primary_->normalAt(t) : Vec3(0.0)),
          cuts_(emptied<Cut>()),
          active_(emptied<std::size_t>()) {}

    /// False if there is no way, or nothing to stand on there.
    bool run();
    [[nodiscard]] const Pose& pose() const { return pose_; }

private:
    [[nodiscard]] double leastGap() const;
    [[nodiscard]] double mostShift() const { return longestPush(shape_, own_.stretch); }
    [[nodiscard]] std::optional<Vec3> nextShift();
    void cut(const KeptClear& kept);
    bool activateNext();
    bool solve();
    bool moveTo(const Vec3& shift);
    /// A list of its own thread: movers are many, and work one after another.
    template <class T>
    static std::vector<T>& emptied() {
        thread_local std::vector<T> list;
        list.clear();
        return list;
    }

    const Phase& phase_;
    const Shape& shape_;
    double t_;
    const Pose& own_;
    Pose pose_;
    const Surface* primary_;
    Vec3 normal_;
    Vec3 shift_{0.0};
    Footing footing_;
    /// What bounds the shift: the barriers as they are at this shift, and of earlier ones those that still bind.
    struct Cut {
        Barrier barrier;
        bool keeps = false; ///< true of every shift, not only of those nearby
    };
    std::vector<Cut>& cuts_;
    std::vector<std::size_t>& active_; ///< of what the phase is kept clear of: what has a part in the shift
};

double Mover::leastGap() const {
    double least = 0.0;
    for (const KeptClear& kept : phase_.clear_of) {
        least = t_ > kept.until ? least : std::min(least, gapTo(kept.surface, shape_, pose_, t_));
    }
    return least;
}

/// Over a convex solid the height is a concave function of the shift. Where the other surface faces up, then, so is the
/// gap, and its tangents bound it for good (Kelley's cutting planes); where it faces down, they do so only nearby.
void Mover::cut(const KeptClear& kept) {
    const Vec3 other = kept.surface.normalAt(t_);
    if (primary_ != nullptr && continues(normal_, other)) {
        return;
    }
    Vec3 way = primary_ != nullptr ? wayAlong(normal_, other) : other;
    const double up = glm::dot(other, normal_);
    if (way != Vec3(0.0)) {
        way += footing_.slope * up;
    }
    const Barrier barrier{way, gapTo(kept.surface, shape_, pose_, t_) - glm::dot(way, shift_)};
    const auto same = std::find_if(cuts_.begin(), cuts_.end(),
                                   [&](const Cut& c) { return glm::length(c.barrier.way - way) < 1e-12; });
    if (same != cuts_.end()) {
        same->barrier.gap = std::min(same->barrier.gap, barrier.gap);
    } else {
        cuts_.push_back({barrier, up > 0.0 && !footing_.steeper});
    }
}

std::optional<Vec3> Mover::nextShift() {
    const double binding = 1e-9 * shape_.length();
    std::erase_if(cuts_,
                  [&](const Cut& c) { return !c.keeps || c.barrier.gap + glm::dot(c.barrier.way, shift_) > binding; });
    for (const std::size_t i : active_) {
        if (cuts_.size() < kMostBarriers) {
            cut(phase_.clear_of[i]);
        }
    }
    std::vector<Barrier>& barriers = emptied<Barrier>();
    std::transform(cuts_.begin(), cuts_.end(), std::back_inserter(barriers), [](const Cut& c) { return c.barrier; });
    const auto next = leastPush(barriers, std::numeric_limits<double>::infinity());
    const double most = mostShift();
    // Where the body only just begins to roll off, the tangent leads too far: from half way it leads back.
    return next && glm::length(*next) > most ? std::optional(*next * (0.5 * most / glm::length(*next))) : next;
}

bool Mover::moveTo(const Vec3& shift) {
    shift_ = shift;
    pose_.position = own_.position + shift;
    if (primary_ == nullptr) {
        return true;
    }
    const auto footing = footingOf(*primary_, shape_, pose_, t_);
    // Far below where it stood there is something, but not what it stands on.
    if (!footing || footing->lift < -2.0 * glm::length(shift) - kRounding * shape_.length()) {
        return false;
    }
    footing_ = *footing;
    pose_.position += normal_ * footing_.lift;
    double lift = 0.0;
    for (const KeptClear& kept : phase_.clear_of) {
        const Vec3 other = kept.surface.normalAt(t_);
        if (t_ <= kept.until && continues(normal_, other)) {
            lift = std::max(lift, -gapTo(kept.surface, shape_, pose_, t_) / glm::dot(normal_, other));
        }
    }
    pose_.position += normal_ * lift;
    return true;
}

/// Takes the first one that the pose is in and that has no part in the shift yet into it. False if there is none.
bool Mover::activateNext() {
    for (std::size_t i = 0; i < phase_.clear_of.size(); ++i) {
        const KeptClear& kept = phase_.clear_of[i];
        if (t_ <= kept.until && std::find(active_.begin(), active_.end(), i) == active_.end() &&
            gapTo(kept.surface, shape_, pose_, t_) < -kRounding * shape_.length()) {
            active_.push_back(i);
            return true;
        }
    }
    return false;
}

bool Mover::run() {
    // One after the other, so that one that does not bind where the others have put the body changes nothing.
    if (!activateNext() || solve()) {
        return true;
    }
    // Again with all at once: what one of them alone asks for may lead away from what there is for all.
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < phase_.clear_of.size(); ++i) {
        if (t_ <= phase_.clear_of[i].until) {
            all.push_back(i);
        }
    }
    if (all.size() < 2) {
        return false;
    }
    const Pose reached = pose_;
    pose_ = own_;
    cuts_.clear();
    active_ = all;
    if (!solve()) {
        pose_ = reached;
        return false;
    }
    return true;
}

/// From no shift on, with those that are active and those that come to it. False if there is no way, or nothing to
/// stand on there.
bool Mover::solve() {
    const double length = shape_.length();
    if (!moveTo(Vec3(0.0))) {
        return false;
    }
    for (int round = 0; round < kMostRounds; ++round) {
        const auto next = nextShift();
        if (!next) {
            return false;
        }
        const bool same = glm::length(*next - shift_) <= 1e-11 * length;
        if (same && leastGap() >= -kRounding * length) {
            return glm::length(shift_) <= mostShift();
        }
        if (!moveTo(*next)) {
            return false;
        }
        if (same && activateNext()) {
            round = 0;
        }
    }
    return leastGap() >= -kGoodEnough * length;
}

} // namespace

namespace {

/// On a plane, or on nothing, and beside one plane alone the gap is linear in the shift. None where that is not so, or
/// no shift helps.
std::optional<Vec3> shiftOffOne(const Phase& phase, const Shape& shape, double t, const Pose& own) {
    const Surface* primary = surfaceOf(phase);
    if (phase.clear_of.size() != 1 || (primary != nullptr && primary->solid)) {
        return std::nullopt;
    }
    const KeptClear& kept = phase.clear_of.front();
    const double gap = t > kept.until ? 0.0 : gapTo(kept.surface, shape, own, t);
    if (gap >= -kRounding * shape.length()) {
        return Vec3(0.0);
    }
    const Vec3 other = kept.surface.normalAt(t);
    const Vec3 way = primary != nullptr ? wayAlong(primary->normalAt(t), other) : other;
    const double squared = glm::dot(way, way);
    const Vec3 shift = squared > 0.0 ? way * (-gap / squared) : Vec3(0.0);
    const double most = longestPush(shape, own.stretch);
    return squared > 0.0 && glm::dot(shift, shift) <= most * most ? std::optional(shift) : std::nullopt;
}

} // namespace

bool moveClear(const Phase& phase, const Shape& shape, double t, Pose& pose) {
    const Pose own = pose;
    if (const auto shift = shiftOffOne(phase, shape, t, own)) {
        pose.position += *shift;
        return true;
    }
    Mover mover(phase, shape, t, own);
    const bool clear = mover.run();
    pose = mover.pose();
    return clear;
}

double longestPush(const Shape& shape, double stretch) {
    constexpr double kMostPush = 2.0;
    return kMostPush * shape.boundingRadius() * std::max(stretch, 1.0 / std::sqrt(stretch));
}

const Surface* surfaceOf(const Phase& phase) {
    if (const auto* impact = phase.as<Impact>()) {
        return &impact->surface;
    }
    if (const auto* slide = phase.as<Slide>()) {
        return &slide->surface;
    }
    const auto* rest = phase.as<Rest>();
    return rest != nullptr ? &rest->surface : nullptr;
}

bool isPressed(const Phase& phase, double t) {
    return std::any_of(phase.clear_of.begin(), phase.clear_of.end(),
                       [&](const KeptClear& kept) { return kept.presses && t <= kept.until; });
}

bool opposes(const Vec3& normal, const Vec3& other) {
    return glm::dot(normal, other) < 0.0 && wayAlong(normal, other) == Vec3(0.0);
}

std::optional<Vec3> leastPush(std::span<const Barrier> all, double most) {
    const std::span<const Barrier> barriers = all.first(std::min(all.size(), kMostBarriers));
    double deepest = 0.0;
    for (const Barrier& barrier : barriers) {
        deepest = std::max(deepest, -barrier.gap);
    }
    if (deepest <= 0.0) {
        return Vec3(0.0);
    }
    Shortest shortest(barriers, 1e-13 * deepest);
    for (std::size_t i = 0; i < barriers.size(); ++i) {
        const Barrier& a = barriers[i];
        const double squared = glm::dot(a.way, a.way);
        if (squared == 0.0) {
            continue;
        }
        shortest.consider(a.way * (-a.gap / squared), {i});
        for (std::size_t j = 0; j < i; ++j) {
            const Barrier& b = barriers[j];
            shortest.consider(onTwo(a.way, -a.gap, b.way, -b.gap), {i, j});
            for (std::size_t k = 0; k < j; ++k) {
                shortest.consider(onThree(a, b, barriers[k]), {i, j, k});
            }
        }
    }
    const auto& best = shortest.best();
    return best && glm::dot(*best, *best) <= most * most ? best : std::nullopt;
}

Fit fitted(const Phase& phase, const Shape& shape, double t) {
    const Pose own = ownPose(phase, shape, t);
    Pose pose = own;
    if (moveClear(phase, shape, t, pose)) {
        return {pose, true, pose.position - own.position};
    }
    // In a corner it stops rather than change its form.
    if (!isPressed(phase, t)) {
        return {pose, false};
    }
    const Squeezed flat = squeezed(phase, shape, t);
    return {flat.pose, flat.fits};
}

Pose keptClear(const Phase& phase, const Shape& shape, double t) {
    return fitted(phase, shape, t).pose;
}

double pushGain(const Phase& phase, double t) {
    const Surface* primary = surfaceOf(phase);
    const Vec3 normal = primary != nullptr ? primary->normalAt(t) : Vec3(0.0);
    std::array<Vec3, kMostBarriers> ways;
    std::size_t count = 0;
    double gain = 0.0;
    for (const KeptClear& kept : phase.clear_of) {
        if (t > kept.until || count == kMostBarriers) {
            continue;
        }
        const Vec3 other = kept.surface.normalAt(t);
        const Vec3 way = primary != nullptr ? wayAlong(normal, other) : other;
        const double length = glm::length(way);
        gain = std::max(gain, length > 0.0 ? 1.0 / length : 4.0);
        if (length > 0.0) {
            ways[count++] = way / length;
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const double across = glm::length(glm::cross(ways[i], ways[j]));
            gain = std::max(gain, 2.0 / std::max(across, 0.1));
        }
    }
    return gain;
}

} // namespace elastoon
