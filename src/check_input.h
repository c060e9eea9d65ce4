// What the world refuses at the door: numbers that are not finite or out of range. Private to the library.
#pragma once

#include "elastoon/world.h"

#include <optional>
#include <string>

namespace elastoon {

inline constexpr double kMostPosition = 1e9;
inline constexpr double kMostSpeed = 1e6;
inline constexpr double kMostSpin = 1e4;
inline constexpr double kMostGravity = 1e6;
inline constexpr double kMostStep = 1e6;
/// A path that repeats takes this long at least, s: a world has to stop at every key.
inline constexpr double kLeastLap = 1e-3;

/// A number as people write it: up to six digits.
[[nodiscard]] std::string shortNumber(double value);

[[nodiscard]] std::optional<Error> checkVector(const Vec3& value, double most, const char* what);
/// Where an obstacle is put.
[[nodiscard]] std::optional<Error> checkPlace(const Vec3& position, const Quat& rotation);
[[nodiscard]] std::optional<Error> checkStyle(const Style& style);
[[nodiscard]] std::optional<Error> checkBodyDef(const BodyDef& def);
[[nodiscard]] std::optional<Error> checkObstacleDef(const ObstacleDef& def);

} // namespace elastoon
