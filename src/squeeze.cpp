// See squeeze.h.
#include "squeeze.h"

#include "contact.h"
#include "push.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace elastoon {

namespace {

/// A body is never squashed or stretched by more than this factor because it has no room.
constexpr double kMostSqueeze = 20.0;
/// Nor stretched by more than this between what stands: it need not have gone there.
constexpr double kMostBetweenStanding = 2.0;

/// How deep the pose is in what the body is kept clear of.
double depthIn(const Phase& phase, const Shape& shape, double t, const Pose& pose) {
    double least = 0.0;
    for (const KeptClear& kept : phase.clear_of) {
        least = t <= kept.until ? std::min(least, gapTo(kept.surface, shape, pose, t)) : least;
    }
    return -least;
}

/// A body under a press, in the forms that it may take there.
class Squeeze {
public:
    Squeeze(const Phase& phase, const Shape& shape, double t) : phase_(phase), shape_(shape), t_(t) {
        const bool closes = surfaceOf(phase)->frame.moves() ||
                            std::any_of(phase.clear_of.begin(), phase.clear_of.end(), [](const KeptClear& kept) {
                                return kept.presses && kept.surface.frame.moves();
                            });
        longest_ = closes ? kMostSqueeze : kMostBetweenStanding;
    }
    [[nodiscard]] std::optional<Pose> fitting() const;
    [[nodiscard]] Pose leastDeep() const;

private:
    static constexpr double kRatio = 1.1;
    /// Calls what(factor) for flatter and longer forms, by and by, until it says that it is enough.
    template <class What>
    void forFactors(What&& what) const {
        for (double ratio = kRatio; ratio < kMostSqueeze; ratio *= kRatio) {
            for (const double factor : {1.0 / ratio, ratio}) {
                if (factor <= longest_ && what(factor)) {
                    return;
                }
            }
        }
    }
    [[nodiscard]] bool tryFactor(double factor, Pose& tried) const {
        tried = ownPose(phase_, shape_, t_, factor);
        return moveClear(phase_, shape_, t_, tried);
    }
    [[nodiscard]] double depth(double factor) const {
        Pose tried;
        (void)tryFactor(factor, tried);
        return depthIn(phase_, shape_, t_, tried);
    }

    const Phase& phase_;
    const Shape& shape_;
    double t_;
    double longest_ = 1.0;
};

/// Flatter or longer, whichever fits sooner; then as near to its own stretch as fits.
std::optional<Pose> Squeeze::fitting() const {
    Pose best;
    double fit = 0.0;
    forFactors([&](double factor) {
        fit = tryFactor(factor, best) ? factor : 0.0;
        return fit > 0.0;
    });
    if (fit == 0.0) {
        return std::nullopt;
    }
    double misfit = fit < 1.0 ? fit * kRatio : fit / kRatio;
    for (int i = 0; i < 48 && std::fabs(fit - misfit) > 1e-13 * fit; ++i) {
        const double middle = 0.5 * (fit + misfit);
        Pose tried;
        if (tryFactor(middle, tried)) {
            fit = middle;
            best = tried;
        } else {
            misfit = middle;
        }
    }
    return best;
}

/// Where no form fits: the one that is least deep, so that what closes on it enters it slowly.
Pose Squeeze::leastDeep() const {
    double best = 1.0;
    double least = depth(1.0);
    forFactors([&](double factor) {
        const double deep = depth(factor);
        if (deep < least) {
            least = deep;
            best = factor;
        }
        return false;
    });
    // Golden section.
    constexpr double kShare = 0.6180339887498949;
    double low = best / kRatio;
    double high = std::min(best * kRatio, std::max(longest_, 1.0));
    for (int i = 0; i < 64; ++i) {
        const double lower = high - kShare * (high - low);
        const double upper = low + kShare * (high - low);
        if (depth(lower) <= depth(upper)) {
            high = upper;
        } else {
            low = lower;
        }
    }
    Pose pose;
    (void)tryFactor(0.5 * (low + high), pose);
    return pose;
}

} // namespace

Squeezed squeezed(const Phase& phase, const Shape& shape, double t) {
    const Squeeze squeeze(phase, shape, t);
    const auto pose = squeeze.fitting();
    return pose ? Squeezed{*pose, true} : Squeezed{squeeze.leastDeep(), false};
}

} // namespace elastoon
