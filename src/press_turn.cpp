// Between parallel plates a body with its axis at angle a to the press's direction is, at its best stretch, as thin as
// the cube root of cos a sin^2 a: both ways from 54.7 degrees get thinner. See press_turn.h.
#include "press_turn.h"

#include "contact.h"
#include "dmath.h"
#include "golden_section.h"
#include "push.h"
#include "rotation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace elastoon {

namespace {

/// Angles (rad) up to this are rounding: such an axis lies along the direction, or across it.
constexpr double kAligned = 1e-6;
/// Gaps that differ by less than this share of the length are alike.
constexpr double kSameGap = 1e-12;
/// A turn that wins less room than this share of the length is none.
constexpr double kWorthwhile = 0.02;
/// Turned away from the press's direction it is stretched no further than this, or it would reach into all that is
/// around.
constexpr double kLongest = 6.0;

/// In the surface's frame: the turn that takes the axis along the press's direction, and what it is short of a right
/// angle.
struct Askew {
    Vec3 axis{0.0};
    double along = 0.0;
    double across = 0.0;
};

Askew askewAt(const Phase& phase, double t) {
    const auto& rest = phase.get<Rest>();
    Vec3 direction(0.0);
    for (const KeptClear& kept : phase.clear_of) {
        if (kept.presses && t <= kept.until) {
            direction += rest.surface.normalAt(t) - kept.surface.normalAt(t);
        }
    }
    direction = glm::conjugate(rest.surface.frame.orientationAt(t)) * glm::normalize(direction);
    const Vec3 axis = principalAxis(rest.pose.orientation);
    const Turn turn = turnBetween(axis, glm::dot(axis, direction) < 0.0 ? -direction : direction);
    return {turn.axis, turn.angle, std::max(0.0, 0.5 * kPi - turn.angle)};
}

/// About x to the power of 2/3, by which the best stretch grows with the tangent of the angle.
double twoThirds(double x) {
    const double half = std::sqrt(x);
    const double eighth = std::sqrt(std::sqrt(half));
    return half * eighth * std::sqrt(std::sqrt(eighth));
}

/// The body at one time, by how far its axis is turned: positive towards the press's direction.
class Turning {
public:
    Turning(const Phase& phase, const Shape& shape, double t, const StretchRange& range)
        : phase_(phase), shape_(shape), t_(t), range_(range), askew_(askewAt(phase, t)) {
        centre_ = roughlyBest();
        own_ = bestAt(0.0);
        const double longest = kLongest / phase.get<Rest>().pose.stretch;
        range_.most = std::clamp(longest, own_.factor, range_.most);
    }

    struct Best {
        double angle = 0.0, factor = 1.0;
        double gap = 0.0;
    };
    [[nodiscard]] static bool isWider(const Best& a, const Best& b) { return a.gap > b.gap; }
    /// The factor that leaves most of a gap at that angle.
    [[nodiscard]] Best bestAt(double angle) const;
    [[nodiscard]] const Best& unturned() const { return own_; }
    /// 1 or -1 for the way in which the gap grows, from the first on if there is one; 0 where there is none.
    [[nodiscard]] int way() const;
    /// The least turn that way with such a gap; where there is none, that of the first greatest one.
    [[nodiscard]] Best leastTurn(int way, double wanted) const;
    [[nodiscard]] Pose poseOf(double angle, double factor) const;

private:
    [[nodiscard]] double gapOf(double angle, double factor) const;
    [[nodiscard]] double roughlyBest() const;
    [[nodiscard]] Best widestWithin(double low, double high) const;
    [[nodiscard]] Best firstGap(Best without, Best with, double wanted) const;
    [[nodiscard]] double whole(int way) const { return way > 0 ? askew_.along : askew_.across; }

    const Phase& phase_;
    const Shape& shape_;
    double t_;
    StretchRange range_;
    Askew askew_;
    double centre_ = 1.0;
    Best own_;
};

Pose Turning::poseOf(double angle, double factor) const {
    const Quat turn = angle != 0.0 ? rotationAbout(askew_.axis, angle) : kNoRotation;
    return ownPose(phase_, shape_, t_, factor, turn);
}

double Turning::gapOf(double angle, double factor) const {
    const Pose pose = poseOf(angle, factor);
    double least = std::numeric_limits<double>::infinity();
    for (const KeptClear& kept : phase_.clear_of) {
        if (kept.presses && t_ <= kept.until) {
            least = std::min(least, gapTo(kept.surface, shape_, pose, t_));
        }
    }
    return least;
}

double Turning::roughlyBest() const {
    constexpr double kRatio = 1.2;
    double best = 1.0;
    double widest = -std::numeric_limits<double>::infinity();
    for (double factor = range_.least; factor <= range_.most; factor *= kRatio) {
        const double gap = gapOf(0.0, factor);
        if (gap > widest) {
            widest = gap;
            best = factor;
        }
    }
    return best;
}

/// By golden section about where the best factor between parallel plates would be.
Turning::Best Turning::bestAt(double angle) const {
    constexpr double kAbout = 2.0;
    constexpr int kRounds = 44;
    double centre = centre_;
    if (angle != 0.0) {
        const SinCos own = detSinCos(askew_.along);
        const SinCos turned = detSinCos(askew_.along - angle);
        centre *= twoThirds(std::max(0.0, turned.sin * own.cos) / std::max(turned.cos * own.sin, 1e-9));
        centre = std::clamp(centre, range_.least, range_.most);
    }
    const double low = std::max(range_.least, centre / kAbout);
    const double high = std::min(range_.most, centre * kAbout);
    const auto at = [&](double factor) { return Best{angle, factor, gapOf(angle, factor)}; };
    const Best first = at(low);
    const Best last = at(high);
    const Best end = isWider(last, first) ? last : first;
    const Best between = goldenSection(low, high, kRounds, at, isWider);
    return isWider(between, end) ? between : end;
}

int Turning::way() const {
    constexpr double kLook = 0.005;
    const double length = shape_.length();
    const double wanted = own_.gap + kWorthwhile * length;
    for (const int way : {1, -1}) {
        if (whole(way) > kLook && bestAt(way * kLook).gap > own_.gap + kSameGap * length &&
            leastTurn(way, wanted).gap >= wanted) {
            return way;
        }
    }
    // It lies on a bump of the gap, or all but as it best lies.
    const double most = std::numeric_limits<double>::infinity();
    const double towards = whole(1) > kAligned ? leastTurn(1, most).gap : own_.gap;
    const double away = whole(-1) > kAligned ? leastTurn(-1, most).gap : own_.gap;
    if (std::max(towards, away) < wanted) {
        return 0;
    }
    return towards >= away ? 1 : -1;
}

/// By the Illinois variant of regula falsi.
Turning::Best Turning::firstGap(Best without, Best with, double wanted) const {
    double below = without.gap - wanted;
    double above = with.gap - wanted;
    int side = 0;
    for (int i = 0; i < 60; ++i) {
        const double span = with.angle - without.angle;
        if (with.gap - wanted <= 0.1 * kSameGap * shape_.length() || std::fabs(span) < 1e-14) {
            break;
        }
        const Best next = bestAt(without.angle + span * (below / (below - above)));
        if (next.gap >= wanted) {
            with = next;
            above = next.gap - wanted;
            below *= side > 0 ? 0.5 : 1.0;
            side = 1;
        } else {
            without = next;
            below = next.gap - wanted;
            above *= side < 0 ? 0.5 : 1.0;
            side = -1;
        }
    }
    return with;
}

/// The one with the widest gap between two angles, by golden section.
Turning::Best Turning::widestWithin(double low, double high) const {
    constexpr int kRounds = 24;
    return goldenSection(low, high, kRounds, [&](double angle) { return bestAt(angle); }, isWider);
}

/// Uphill, but for the bumps that corners make: beyond a dip there may be more room, but the body would jump there.
Turning::Best Turning::leastTurn(int way, double wanted) const {
    constexpr int kSteps = 12;
    constexpr double kBump = 0.01;
    const double step = way * whole(way) / kSteps;
    Best last = own_;
    Best widest = own_;
    int widest_at = 0;
    for (int i = 1; i <= kSteps; ++i) {
        const Best next = bestAt(i == kSteps ? way * whole(way) : step * i);
        if (next.gap >= wanted) {
            return firstGap(last, next, wanted);
        }
        if (next.gap < widest.gap - kBump * shape_.length()) {
            break;
        }
        if (next.gap > widest.gap) {
            widest = next;
            widest_at = i;
        }
        last = next;
    }
    if (widest_at == 0 || wanted == std::numeric_limits<double>::infinity()) {
        return widest;
    }
    const double before = step * (widest_at - 1);
    const Best between = widestWithin(before, step * std::min(widest_at + 1, kSteps));
    if (between.gap >= wanted) {
        return firstGap(bestAt(before), between, wanted);
    }
    return between.gap > widest.gap ? between : widest;
}

} // namespace

std::optional<PressTurn> turnUnderPress(const Phase& phase, const Shape& shape, double t, const StretchRange& range) {
    const Turning turning(phase, shape, t, range);
    Turning::Best best = turning.unturned();
    if (best.gap < 0.0) {
        // The way is chosen for the whole phase: one that fits sooner later on would be a jump.
        const int way = Turning(phase, shape, phase.start, range).way();
        best = way != 0 ? turning.leastTurn(way, 0.0) : best;
        if (best.angle == 0.0) {
            return std::nullopt;
        }
    }
    // What else there is moves it aside, but has no part in how it lies: so it changes nothing when it comes near.
    Pose pose = turning.poseOf(best.angle, best.factor);
    Phase aside = phase;
    std::erase_if(aside.clear_of, [](const KeptClear& kept) { return kept.presses; });
    const bool clear = aside.clear_of.empty() || moveClear(aside, shape, t, pose);
    return PressTurn{best.angle, best.factor, pose, best.gap >= 0.0 && clear};
}

} // namespace elastoon
