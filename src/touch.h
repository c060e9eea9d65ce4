// When a body in flight first touches a plane: conservative advancement, finished by a bracketed root.
#pragma once

#include "elastoon/phase.h"

#include <optional>

namespace elastoon {

/// The body counts as touching at this share of its length: what separates a touch from rounding.
inline constexpr double kTouchGap = 1e-9;

/// First time in [from, to] at which the flight's body touches the plane; it does not penetrate at that time.
/// None if there is no touch. At `from` a gap of kTouchGap or less is a touch.
[[nodiscard]] std::optional<double> firstTouch(const Phase& flight, const Shape& shape, const Surface& surface,
                                               double from, double to);

} // namespace elastoon
