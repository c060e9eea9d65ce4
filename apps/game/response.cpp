// See response.h.
#include "response.h"

#include <algorithm>

namespace squashout {

using elastoon::ImpactCurve;
using elastoon::Mat3;
using elastoon::Vec3;

Response::Response(const elastoon::Style& style, double length, double speed, double t, const Vec3& axis,
                   const Vec3& anchor)
    : begun_(t), axis_(axis), anchor_(anchor) {
    double incoming = speed;
    double from = 1.0;
    for (ImpactCurve& curve : curves_) {
        const double outgoing = incoming * style.restitution * 0.8;
        const double overshoot = elastoon::stretchAtSpeed(style, outgoing * 0.5);
        curve = elastoon::impactCurve(style, {.length = length,
                                              .speed_in = incoming,
                                              .s_in = from,
                                              .speed_out = outgoing,
                                              .s_out = overshoot,
                                              .rest_speed = 0.0});
        span_ += curve.duration();
        from = overshoot;
        incoming = outgoing;
    }
    settling_ = elastoon::recoveryCurve(style, length, from);
    span_ += settling_.duration();
}

double Response::stretchAt(double t) const {
    double left = t - begun_;
    if (left < 0.0 || over(t)) {
        return 1.0;
    }
    for (const ImpactCurve& curve : curves_) {
        if (left < curve.duration()) {
            return curve.at(left);
        }
        left -= curve.duration();
    }
    return settling_.at(left);
}

void Response::apply(double t, Vec3& position, Mat3& linear) const {
    const double stretch = stretchAt(t);
    if (stretch == 1.0) {
        return;
    }
    const double across = elastoon::scaleOf(stretch).y;
    Mat3 scale(across);
    for (int column = 0; column < 3; ++column) {
        scale[column] += axis_ * ((stretch - across) * axis_[column]);
    }
    linear = scale * linear;
    position += axis_ * ((stretch - 1.0) * glm::dot(position - anchor_, axis_));
}

} // namespace squashout
