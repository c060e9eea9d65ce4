// The motion model's two curves: stretch by speed in flight, and stretch through an impact. Paper, sections 3.2
// and 3.4.
#pragma once

#include "elastoon/export.h"
#include "elastoon/style.h"

namespace elastoon ELASTOON_API {

/// Share of the extra stretch that a speed gives, k v / (k v + 1). 0 at no speed, 1 at infinite speed.
[[nodiscard]] double stretchShare(const Style& style, double speed);

/// Stretch of a body that flies at `speed` m/s: (k v s_max + 1) / (k v + 1). Paper, section 3.2.
[[nodiscard]] double stretchAtSpeed(const Style& style, double speed);

/// Deepest squash s_mid of an impact met at `relative_speed` m/s. Paper, section 3.4, misprint mended: docs/model.md.
[[nodiscard]] double deepestSquash(const Style& style, double relative_speed);

/// The rest speed that holds for a body of this length under this gravity: the style's, or the derived one. m/s.
[[nodiscard]] double restSpeed(const Style& style, double length, double gravity_magnitude);

/// What an impact's curve is made from.
struct ImpactInput {
    double length = 1.0;    ///< L, full extent along the principal axis at s = 1, m
    double speed_in = 0.0;  ///< |v_r|, relative to the surface, m/s
    double s_in = 1.0;      ///< stretch at the touch
    double speed_out = 0.0; ///< |v_out - w|, relative to the surface, m/s
    double s_out = 1.0;     ///< stretch of the flight or rest that follows
    double rest_speed = 0.0;
    bool turns = false; ///< the body has to turn, which takes time even where nothing squashes
};

/// Stretch through an impact, the paper's figure 4: a sine down to s_mid, a cosine up to s_out.
struct ImpactCurve {
    double s_in = 1.0, s_mid = 1.0, s_out = 1.0;
    double omega_in = 0.0, omega_out = 0.0; ///< rad/s; 0 where the half takes no time
    double t_in = 0.0, t_out = 0.0;         ///< duration of the squash half and of the stretch half, s

    [[nodiscard]] double duration() const { return t_in + t_out; }
    /// Stretch at local time t; the ends hold outside 0..duration().
    [[nodiscard]] double at(double t) const;
    bool operator==(const ImpactCurve& other) const = default;
};

/// The curve of one impact. Paper, section 3.4; floors and limits: docs/model.md.
[[nodiscard]] ImpactCurve impactCurve(const Style& style, const ImpactInput& input);

/// The curve of a touch that skips along the surface: pressed flat it lengthens along it, by the share of the extra
/// stretch that its normal speed gives. Speeds in `input` are along the normal.
[[nodiscard]] ImpactCurve skipCurve(const Style& style, const ImpactInput& input);
/// The same in `factor` (> 0) times the time.
[[nodiscard]] ImpactCurve inTimes(const ImpactCurve& curve, double factor);
/// The curve with the other's durations mixed in: `share` 0 leaves them, 1 takes the other's.
[[nodiscard]] ImpactCurve withTimesOf(const ImpactCurve& curve, const ImpactCurve& other, double share);
/// The curve with another end.
[[nodiscard]] ImpactCurve withEnd(const ImpactCurve& curve, const Style& style, double length, double speed_out,
                                  double s_out);

/// How long a body takes to its own form where no speed drives it, s: the squash half of the gentlest impact.
[[nodiscard]] double settlingTime(const Style& style, double length);

/// From a squeezed form back to s = 1, as from the deepest squash: the squash half takes no time.
[[nodiscard]] ImpactCurve recoveryCurve(const Style& style, double length, double stretch);

/// Share 0..1 of the whole turn that is done at local time t of an impact: 1/2 at t_in for either easing.
[[nodiscard]] double turnShare(const ImpactCurve& curve, ImpactEasing easing, double t);

} // namespace elastoon ELASTOON_API
