// How a body moves: the style parameters, and the one table of them that every reader, slider and page is made from.
#pragma once

#include "elastoon/export.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace elastoon ELASTOON_API {

/// How deep the squash goes. Docs: docs/model.md.
enum class SquashLaw : std::uint8_t {
    Bounded, ///< no squash at no speed; the contact time stays bounded
    Paper,   ///< as the paper's section 3.4 prints it, its misprint mended
};

/// How the turn about the contact runs through an impact. Both pass half of the angle at the deepest squash.
enum class ImpactEasing : std::uint8_t {
    Smooth, ///< starts and ends without a corner in angular speed
    Linear, ///< constant rate in each half, the paper's
};

/// What becomes of a surface that is touched while the body is in an impact with another. docs/contacts.md.
enum class CornerRule : std::uint8_t {
    Queued,  ///< it waits until the first impact is over, the paper's
    Blended, ///< while the body still squashes, both throw it back at once
};

/// Says "derive it from the body": see Style::rest_speed.
inline constexpr double kDerived = -1.0;

/// The character of a body's motion. Plain data; every field has its row in styleParameters().
struct Style {
    /// Share of the normal speed that is kept in an impact. 0..1; above 1 for super balls. Default 0.5. Paper,
    /// section 3.
    double restitution = 0.5;
    /// Stretch approached at infinite speed, s_max. >= 1. Default 2. Paper, section 3.
    /// 1 -> rigid in flight; 1.5 -> stiff; 2 -> lively; 3 and more -> a streak.
    double max_stretch = 2.0;
    /// Length left in the hardest hit, s_min. 0 < s_min <= 1. Default 0.5. Paper, section 3.
    /// 1 -> never squashes; 0.7 -> stiff; 0.2 -> a pancake.
    double min_squash = 0.5;
    /// How fast the stretch grows with speed, k_str, s/m; half of it is reached at speed 1/k_str. >= 0. Default 0.1.
    double stretch_rate = 0.1;
    /// How fast an impact runs, k_sq. > 0. Default 1: the far end's speed at touchdown is met; 2 meets the centre's.
    /// Higher -> light and snappy; lower -> heavy, lingering.
    double squash_rate = 1.0;
    /// Which law gives the deepest squash. Default Bounded.
    SquashLaw squash_law = SquashLaw::Bounded;
    /// How the turn runs through an impact. Default Smooth.
    ImpactEasing impact_easing = ImpactEasing::Smooth;
    /// Fastest turn of the axis at the top of a steep throw, rad/s. > 0. Default 4 pi.
    /// Where the path turns faster, the forward end is swapped instead (paper, section 3.2).
    double reversal_rate = 12.566370614359172;
    /// Outgoing normal speed below which a touch brings the body to rest, m/s. >= 0, or kDerived.
    /// Derived: sqrt(2 |g| 0.02 L), a hop of 2 % of the body's length. A twentieth of that always holds.
    double rest_speed = kDerived;
    /// Steepest surface that can hold a body at rest, rad from level. 0 to pi/2. Default 35 degrees. Paper,
    /// section 3.5.
    double rest_slope = 0.6108652381980153;

    /// Share of the pressing force that slows a slide, mu. >= 0. Default 0.4. 0 -> ice; 1 -> rubber on stone.
    double friction = 0.4;
    /// Incidence from the surface below which a touch skips instead of turning end over end, rad. 0 to pi/2. Default 30
    /// degrees; 0: never. From half of it down the body keeps all of its way along the surface.
    double grazing_angle = 0.5235987755982988;
    /// What a second surface does that is touched during an impact. Default Queued.
    CornerRule corner_rule = CornerRule::Queued;

    friend bool operator==(const Style&, const Style&) = default;
};

/// One row of the parameter table. Numbers are in the file's unit; file_to_si converts to the field's.
struct StyleParameter {
    std::string_view name; ///< key in files, field of Style
    std::string_view symbol; ///< as docs/model.md writes it
    std::string_view unit; ///< in files; empty for a pure number
    double minimum; ///< least value allowed
    double maximum; ///< greatest value allowed
    double default_value;
    double file_to_si; ///< field = file value * file_to_si
    std::string_view meaning; ///< one line
    double Style::* number; ///< the field; null for a choice
    std::span<const std::string_view> choices; ///< names of a choice, in the order of its enum; empty for a number
    bool may_be_derived = false; ///< takes "auto" as well, stored as kDerived
};

/// Every style parameter, in the order in which people read them.
[[nodiscard]] std::span<const StyleParameter> styleParameters();

/// The parameter's value in the file's unit; the index of a choice; kDerived for a derived one.
[[nodiscard]] double parameterValue(const Style& style, const StyleParameter& parameter);
/// Sets it, in the file's unit. The value must be allowed.
void setParameter(Style& style, const StyleParameter& parameter, double value);

/// A style that comes with the library. The files of scenes/styles/ are their source; docs/gallery.md shows them.
struct NamedStyle {
    std::string_view name; ///< as in "jelly"
    std::string_view description; ///< one line
    Style style;
};

/// All styles that come with the library, by name.
[[nodiscard]] std::span<const NamedStyle> namedStyles();
/// Their names alone, in the same order.
[[nodiscard]] std::vector<std::string_view> styleNames();
/// The style of this name; none if there is no such one.
[[nodiscard]] std::optional<Style> styleNamed(std::string_view name);

} // namespace elastoon ELASTOON_API
