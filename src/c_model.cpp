// The C interface to the motion model's curves. See elastoon.h.
#include "elastoon/model.h"

#include "c_interface.h"
#include "check_input.h"

#include <algorithm>
#include <array>

using namespace elastoon;
using namespace elastoon::c_interface;

namespace {

ElastoonResult checkStyle(const ElastoonStyle& style) {
    if (const ElastoonResult choices = checkChoices(style); choices != kElastoonOk) {
        return choices;
    }
    const auto flaw = elastoon::checkStyle(from(style));
    return flaw ? refuse(kElastoonBadArgument, *flaw) : kElastoonOk;
}

ElastoonResult checkWithin(double value, double least, double most, const char* name) {
    return value >= least && value <= most ? kElastoonOk
                                           : refuse(kElastoonBadArgument,
                                                    "must be from " + shortNumber(least) + " to " + shortNumber(most) +
                                                        ", is " + shortNumber(value),
                                                    name);
}

} // namespace

ElastoonResult elastoonStretchAtSpeed(const ElastoonStyle* style, double speed, double* out_stretch) {
    return guarded([&] {
        if (style == nullptr || out_stretch == nullptr) {
            return nullPointer("style and out_stretch");
        }
        ElastoonResult result = ::checkStyle(*style);
        if (result == kElastoonOk) {
            result = checkWithin(speed, 0.0, kMostSpeed, "speed");
        }
        if (result == kElastoonOk) {
            *out_stretch = stretchAtSpeed(from(*style), speed);
        }
        return result;
    });
}

ElastoonResult elastoonImpactCurve(const ElastoonStyle* style, const ElastoonImpactInput* input,
                                   ElastoonImpactCurve* out_curve) {
    return guarded([&] {
        if (style == nullptr || input == nullptr || out_curve == nullptr) {
            return nullPointer("style, input and out_curve");
        }
        ElastoonResult result = ::checkStyle(*style);
        struct Bound {
            const char* name;
            double value, least, most;
        };
        const std::array<Bound, 6> bounds{{{"length", input->length, 1e-9, 1e9},
                                           {"speed_in", input->speed_in, 0.0, kMostSpeed},
                                           {"s_in", input->s_in, 1e-3, 1e3},
                                           {"speed_out", input->speed_out, 0.0, 10.0 * kMostSpeed},
                                           {"s_out", input->s_out, 1e-3, 1e3},
                                           {"rest_speed", input->rest_speed, 0.0, kMostSpeed}}};
        for (const Bound& bound : bounds) {
            if (result == kElastoonOk) {
                result = checkWithin(bound.value, bound.least, bound.most, bound.name);
            }
        }
        if (result != kElastoonOk) {
            return result;
        }
        const ImpactCurve curve =
            impactCurve(from(*style), {input->length, input->speed_in, input->s_in, input->speed_out, input->s_out,
                                       input->rest_speed, input->turns});
        *out_curve = {curve.s_in, curve.s_mid, curve.s_out, curve.omega_in, curve.omega_out, curve.t_in, curve.t_out};
        return kElastoonOk;
    });
}

ElastoonResult elastoonImpactCurveAt(const ElastoonImpactCurve* curve, const double* times, size_t count,
                                     double* out_stretches) {
    if (curve == nullptr || ((times == nullptr || out_stretches == nullptr) && count > 0)) {
        return nullPointer("curve, times and out_stretches");
    }
    const ImpactCurve evaluated{curve->s_in,      curve->s_mid, curve->s_out, curve->omega_in,
                                curve->omega_out, curve->t_in,  curve->t_out};
    std::transform(times, times + count, out_stretches, [&](double time) { return evaluated.at(time); });
    return kElastoonOk;
}
