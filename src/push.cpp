// Based on: Chenney et al., NPAR 2002, section 3.6. The shift is the shortest one out of half spaces, found among the
// few sets of them that can hold it. See push.h.
#include "push.h"

#include "contact.h"
#include "flight.h"
#include "impact.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace elastoon {

namespace {

/// Depths up to this share of the length are rounding.
constexpr double kRounding = 1e-12;
/// A way along the surface shorter than this (of a unit normal) is none: a wedge under 15 degrees lets nothing out.
constexpr double kLeastWay = 0.25;
constexpr std::size_t kMostBarriers = 16;
/// A body is never squashed or stretched by more than this factor because it has no room.
constexpr double kMostSqueeze = 20.0;
/// The same where nothing presses it: it stops rather than change its form much.
constexpr double kMostSqueezeInCorner = 1.3;
/// Between pushing along the surface and putting the body back onto it.
constexpr int kMostRounds = 12;

bool feasible(std::span<const Barrier> barriers, const Vec3& shift, double slack) {
    return std::all_of(barriers.begin(), barriers.end(),
                       [&](const Barrier& b) { return b.gap + glm::dot(shift, b.way) >= -slack; });
}

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

    void consider(const std::optional<Vec3>& shift) {
        if (!shift) {
            return;
        }
        const double squared = glm::dot(*shift, *shift);
        if ((!best_ || squared < squared_) && feasible(barriers_, *shift, slack_)) {
            best_ = shift;
            squared_ = squared;
        }
    }
    [[nodiscard]] const std::optional<Vec3>& best() const { return best_; }

private:
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

/// Takes the pose out of all surfaces by moving it. False if that cannot be done.
bool moveClear(const Phase& phase, const Shape& shape, double t, Pose& pose) {
    const Surface* primary = surfaceOf(phase);
    const Vec3 normal = primary != nullptr ? primary->normalAt(t) : Vec3(0.0);
    const double length = shape.length();
    for (int round = 0; round < kMostRounds; ++round) {
        std::array<Barrier, kMostBarriers> barriers;
        std::size_t count = 0;
        double lift = 0.0;
        bool clear = true;
        for (const KeptClear& kept : phase.clear_of) {
            if (t > kept.until || count == kMostBarriers) {
                continue;
            }
            const Vec3 other = kept.surface.normalAt(t);
            const double gap = gapTo(kept.surface, shape, pose, t);
            clear = clear && gap >= -kRounding * length;
            if (primary != nullptr && continues(normal, other)) {
                lift = std::max(lift, -gap / glm::dot(normal, other));
            } else {
                barriers[count++] = {primary != nullptr ? wayAlong(normal, other) : other, gap};
            }
        }
        if (clear) {
            return true;
        }
        const auto shift = leastPush({barriers.data(), count}, 4.0 * length * std::max(1.0, pose.stretch));
        if (!shift) {
            return false;
        }
        pose.position += *shift + normal * lift;
        if (primary != nullptr && primary->solid && lift <= 0.0) {
            Pose in_frame{primary->frame.frameFromWorld(t, pose.position),
                          glm::conjugate(primary->frame.orientationAt(t)) * pose.orientation, pose.stretch};
            // Down again by no more than it went along: beyond the solid's end there is nothing to stand on.
            pose.position += normal * std::max(liftToTouch(*primary, shape, in_frame), -glm::length(*shift));
        }
    }
    // What is left after so many rounds is far below what shows.
    return true;
}

} // namespace

const Surface* surfaceOf(const Phase& phase) {
    if (const auto* impact = std::get_if<Impact>(&phase.motion)) {
        return &impact->surface;
    }
    if (const auto* slide = std::get_if<Slide>(&phase.motion)) {
        return &slide->surface;
    }
    const auto* rest = std::get_if<Rest>(&phase.motion);
    return rest != nullptr ? &rest->surface : nullptr;
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
        shortest.consider(a.way * (-a.gap / squared));
        for (std::size_t j = 0; j < i; ++j) {
            const Barrier& b = barriers[j];
            shortest.consider(onTwo(a.way, -a.gap, b.way, -b.gap));
            for (std::size_t k = 0; k < j; ++k) {
                shortest.consider(onThree(a, b, barriers[k]));
            }
        }
    }
    const auto& best = shortest.best();
    return best && glm::dot(*best, *best) <= most * most ? best : std::nullopt;
}

namespace {

struct Fit {
    Pose pose;
    bool fits = true;
};

bool isPressed(const Phase& phase, double t) {
    const Surface* primary = surfaceOf(phase);
    return primary != nullptr && std::any_of(phase.clear_of.begin(), phase.clear_of.end(), [&](const KeptClear& kept) {
               return opposes(primary->normalAt(t), kept.surface.normalAt(t));
           });
}

/// Flatter or longer, whichever fits sooner; then as near to its own stretch as fits.
Fit squeezed(const Phase& phase, const Shape& shape, double t, const Pose& unfit) {
    const auto tryFactor = [&](double factor, Pose& tried) {
        tried = ownPose(phase, shape, t, factor);
        return moveClear(phase, shape, t, tried);
    };
    constexpr double kRatio = 1.1;
    const double most = isPressed(phase, t) ? kMostSqueeze : kMostSqueezeInCorner;
    Fit best{unfit, false};
    double fit = 1.0;
    double misfit = 1.0;
    for (double ratio = kRatio; ratio < most && !best.fits; ratio *= kRatio) {
        for (const double factor : {1.0 / ratio, ratio}) {
            if (!best.fits && tryFactor(factor, best.pose)) {
                best.fits = true;
                fit = factor;
                misfit = factor < 1.0 ? factor * kRatio : factor / kRatio;
            }
        }
    }
    for (int i = 0; best.fits && i < 48 && std::fabs(fit - misfit) > 1e-13 * fit; ++i) {
        const double middle = 0.5 * (fit + misfit);
        Pose tried;
        if (tryFactor(middle, tried)) {
            fit = middle;
            best.pose = tried;
        } else {
            misfit = middle;
        }
    }
    return best.fits ? best : Fit{unfit, false};
}

Fit fitted(const Phase& phase, const Shape& shape, double t) {
    const Pose own = ownPose(phase, shape, t);
    Pose pose = own;
    if (moveClear(phase, shape, t, pose)) {
        return {pose, true};
    }
    return std::holds_alternative<Flight>(phase.motion) ? Fit{pose, false} : squeezed(phase, shape, t, own);
}

} // namespace

Pose keptClear(const Phase& phase, const Shape& shape, double t) {
    return fitted(phase, shape, t).pose;
}

double blockedAt(const Phase& phase, const Shape& shape) {
    constexpr int kLooks = 48;
    double fits_at = phase.start;
    for (int i = 0; i <= kLooks; ++i) {
        const double t = i == kLooks ? phase.end : phase.start + (phase.end - phase.start) * i / kLooks;
        if (fitted(phase, shape, t).fits) {
            fits_at = t;
            continue;
        }
        double blocked = t;
        while (blocked - fits_at > 1e-9 * (phase.end - phase.start)) {
            const double middle = 0.5 * (fits_at + blocked);
            (fitted(phase, shape, middle).fits ? fits_at : blocked) = middle;
        }
        return fits_at;
    }
    return phase.end;
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
