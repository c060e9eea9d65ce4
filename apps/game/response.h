// How what does not move answers a hit: blocks and the paddle are obstacles to the library, rigid and immovable. What
// is drawn of them squashes by the library's own curves, as a body of their style would that bounces in place.
#pragma once

#include "elastoon/math.h"
#include "elastoon/model.h"

#include <array>

namespace squashout {

/// The answer to one hit: a squash at the hit's speed, its overshoot, and lesser ones after it.
class Response {
public:
    Response() = default;
    /// `length`: extent along the axis, m. `axis`: unit, of the hit. `anchor`: a point that stays where it is, m.
    Response(const elastoon::Style& style, double length, double speed, double t, const elastoon::Vec3& axis,
             const elastoon::Vec3& anchor);

    /// Scale along the axis at time t; the volume is kept across it. 1 before the hit and when all is over.
    [[nodiscard]] double stretchAt(double t) const;
    [[nodiscard]] bool over(double t) const { return t >= begun_ + span_; }
    /// Of a thing that stands at `position` with linear part `linear`: where it is drawn at time t, and how.
    void apply(double t, elastoon::Vec3& position, elastoon::Mat3& linear) const;
    /// The point that stays goes along with what it is on.
    void carry(const elastoon::Vec3& by) { anchor_ += by; }

private:
    static constexpr std::size_t kTimes = 3;
    std::array<elastoon::ImpactCurve, kTimes> curves_{};
    elastoon::ImpactCurve settling_{};
    double begun_ = 0.0, span_ = 0.0;
    elastoon::Vec3 axis_{0.0, 1.0, 0.0}, anchor_{0.0};
};

} // namespace squashout
