// See squeeze.h.
#include "squeeze.h"

#include "contact.h"
#include "golden_section.h"
#include "press_turn.h"
#include "push.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace elastoon {

namespace {

/// A body is never squashed or stretched by more than this factor because it has no room.
constexpr double kMostSqueeze = 20.0;
/// Nor stretched by more than this between what stands, unless it rests there: it need not have gone there.
constexpr double kMostBetweenStanding = 2.0;

/// How deep the pose is in what the body is kept clear of.
double depthIn(const Phase& phase, const Shape& shape, double t, const Pose& pose) {
    double least = 0.0;
    for (const KeptClear& kept : phase.clear_of) {
        least = t <= kept.until ? std::min(least, gapTo(kept.surface, shape, pose, t)) : least;
    }
    return -least;
}

constexpr double kRatio = 1.1; ///< of one form's factor to the next one that is tried

/// The body with its own stretch times `factor`, moved clear as far as that goes.
struct Form {
    double factor = 1.0;
    Pose pose;
    bool fits = false;
    double depth = 0.0;
};

/// A body under a press, in the forms that it may take there.
class Squeeze {
public:
    Squeeze(const Phase& phase, const Shape& shape, double t) : phase_(phase), shape_(shape), t_(t) {
        const bool closes = phase.is<Rest>() || surfaceOf(phase)->frame.moves() ||
                            std::any_of(phase.clear_of.begin(), phase.clear_of.end(), [](const KeptClear& kept) {
                                return kept.presses && kept.surface.frame.moves();
                            });
        // No stretch goes beyond the most either: where one phase after the other stretches it, it would have no end.
        longest_ = std::clamp(kMostSqueeze / ownPose(phase, shape, t).stretch, 1.0,
                              closes ? kMostSqueeze : kMostBetweenStanding);
    }
    /// Flatter or longer, whichever fits sooner; then as near to its own stretch as fits.
    [[nodiscard]] Squeezed run() const {
        Form shallowest = formOf(1.0);
        for (double ratio = kRatio; ratio < kMostSqueeze; ratio *= kRatio) {
            for (const double factor : {1.0 / ratio, ratio}) {
                if (factor > longest_) {
                    continue;
                }
                const Form form = formOf(factor);
                if (form.fits) {
                    return {nearestToOwn(form).pose, true};
                }
                shallowest = form.depth < shallowest.depth ? form : shallowest;
            }
        }
        if (phase_.is<Rest>()) {
            if (const auto turned = atRest()) {
                return *turned;
            }
        }
        return {shallowestAbout(shallowest.factor).pose, false};
    }

private:
    [[nodiscard]] std::optional<Squeezed> atRest() const;
    [[nodiscard]] Form formOf(double factor) const {
        Form form{factor, ownPose(phase_, shape_, t_, factor)};
        form.fits = moveClear(phase_, shape_, t_, form.pose);
        form.depth = form.fits ? 0.0 : depthIn(phase_, shape_, t_, form.pose);
        return form;
    }
    [[nodiscard]] Form nearestToOwn(Form fit) const;
    [[nodiscard]] Form shallowestAbout(double factor) const;

    const Phase& phase_;
    const Shape& shape_;
    double t_;
    double longest_ = 1.0;
};

Form Squeeze::nearestToOwn(Form fit) const {
    double misfit = fit.factor < 1.0 ? fit.factor * kRatio : fit.factor / kRatio;
    for (int i = 0; i < 48 && std::fabs(fit.factor - misfit) > 1e-13 * fit.factor; ++i) {
        const Form form = formOf(0.5 * (fit.factor + misfit));
        if (form.fits) {
            fit = form;
        } else {
            misfit = form.factor;
        }
    }
    return fit;
}

/// Where no form fits: the one that is least deep, by golden section, so that what closes on it enters it slowly.
Form Squeeze::shallowestAbout(double factor) const {
    constexpr int kRounds = 40;
    return goldenSection(
        factor / kRatio, std::min(factor * kRatio, longest_), kRounds, [&](double f) { return formOf(f); },
        [](const Form& a, const Form& b) { return a.depth < b.depth; });
}

/// Where none of the forms that were tried fits: one between them, or one for which it turns.
std::optional<Squeezed> Squeeze::atRest() const {
    const auto turn = turnUnderPress(phase_, shape_, t_, {1.0 / kMostSqueeze, longest_});
    if (!turn || turn->angle != 0.0) {
        return turn ? std::optional(Squeezed{turn->pose, turn->fits}) : std::nullopt;
    }
    const Form form = formOf(turn->factor);
    return form.fits ? std::optional(Squeezed{nearestToOwn(form).pose, true}) : std::nullopt;
}

} // namespace

Squeezed squeezed(const Phase& phase, const Shape& shape, double t) {
    return Squeeze(phase, shape, t).run();
}

bool fitsUnderPress(const Phase& phase, const Shape& shape, double t) {
    Phase pressed = phase;
    std::erase_if(pressed.clear_of, [](const KeptClear& kept) { return !kept.presses; });
    return squeezed(pressed, shape, t).fits;
}

} // namespace elastoon
