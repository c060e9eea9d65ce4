// The parameter table. See style.h.
#include "elastoon/style.h"

#include "dmath.h"

#include <array>

namespace elastoon {

namespace {

constexpr std::array<std::string_view, 2> kSquashLawNames{"bounded", "paper"};
constexpr std::array<std::string_view, 2> kImpactEasingNames{"smooth", "linear"};
constexpr std::array<std::string_view, 2> kCornerRuleNames{"queued", "blended"};
constexpr double kRadiansPerDegree = kPi / 180.0;

constexpr std::array<StyleParameter, 13> kParameters{{
    {"restitution",
     "r",
     "",
     0.0,
     10.0,
     0.5,
     1.0,
     "share of the normal speed kept in an impact; above 1 for super balls",
     &Style::restitution,
     {}},
    {"max_stretch", "s_max", "", 1.0, 100.0, 2.0, 1.0, "stretch approached at infinite speed", &Style::max_stretch, {}},
    {"min_squash", "s_min", "", 0.01, 1.0, 0.5, 1.0, "squash reached at the hardest hit", &Style::min_squash, {}},
    {"stretch_rate",
     "k_str",
     "s/m",
     0.0,
     1000.0,
     0.1,
     1.0,
     "how fast the stretch grows: half of it is reached at speed 1/k_str",
     &Style::stretch_rate,
     {}},
    {"squash_rate",
     "k_sq",
     "",
     0.001,
     1000.0,
     1.0,
     1.0,
     "how fast an impact runs: high looks light, low looks heavy",
     &Style::squash_rate,
     {}},
    {"squash_law", "", "", 0.0, 1.0, 0.0, 1.0, "how deep the squash goes: bounded in time, or as the paper prints it",
     nullptr, kSquashLawNames},
    {"impact_easing", "", "", 0.0, 1.0, 0.0, 1.0, "how the turn runs through an impact", nullptr, kImpactEasingNames},
    {"reversal_rate",
     "",
     "deg/s",
     1.0,
     1e6,
     720.0,
     kRadiansPerDegree,
     "fastest turn at the top of a steep throw; beyond it the forward end is swapped",
     &Style::reversal_rate,
     {}},
    {"rest_speed",
     "",
     "m/s",
     0.0,
     1e6,
     kDerived,
     1.0,
     "outgoing normal speed below which a touch brings the body to rest; auto: a hop of 2 % of its length",
     &Style::rest_speed,
     {},
     true},
    {"rest_slope",
     "",
     "deg",
     0.0,
     90.0,
     35.0,
     kRadiansPerDegree,
     "steepest surface that can hold a body at rest",
     &Style::rest_slope,
     {}},
    {"friction", "mu", "", 0.0, 100.0, 0.4, 1.0, "how much a slide along a surface is slowed", &Style::friction, {}},
    {"grazing_angle",
     "",
     "deg",
     0.0,
     90.0,
     30.0,
     kRadiansPerDegree,
     "incidence from the surface below which a touch skips instead of turning end over end",
     &Style::grazing_angle,
     {}},
    {"corner_rule", "", "", 0.0, 1.0, 0.0, 1.0,
     "whether a second surface waits for its turn, or both throw the body back at once", nullptr, kCornerRuleNames},
}};

} // namespace

std::span<const StyleParameter> styleParameters() {
    return kParameters;
}

double parameterValue(const Style& style, const StyleParameter& parameter) {
    if (parameter.number != nullptr) {
        const double value = style.*parameter.number;
        return parameter.may_be_derived && value == kDerived ? kDerived : value / parameter.file_to_si;
    }
    return parameter.name == "squash_law"      ? static_cast<double>(style.squash_law)
           : parameter.name == "impact_easing" ? static_cast<double>(style.impact_easing)
                                               : static_cast<double>(style.corner_rule);
}

void setParameter(Style& style, const StyleParameter& parameter, double value) {
    if (parameter.number != nullptr) {
        const bool derived = parameter.may_be_derived && value == kDerived;
        style.*parameter.number = derived ? kDerived : value * parameter.file_to_si;
    } else if (parameter.name == "squash_law") {
        style.squash_law = static_cast<SquashLaw>(static_cast<int>(value));
    } else if (parameter.name == "impact_easing") {
        style.impact_easing = static_cast<ImpactEasing>(static_cast<int>(value));
    } else {
        style.corner_rule = static_cast<CornerRule>(static_cast<int>(value));
    }
}

} // namespace elastoon
