// Trigonometry with the same bits on every machine: only + - * / sqrt and exact conversions. docs/determinism.md.
#pragma once

namespace elastoon {

inline constexpr double kPi = 3.14159265358979323846;

struct SinCos {
    double sin, cos;
};

/// Both at once. Error < 4e-16 for |angle| <= 1e6 rad; beyond it the reduction loses digits: < 1e-6 at 1e9.
[[nodiscard]] SinCos detSinCos(double angle);
/// Angle of (x, y) in -pi..pi; 0 for (0, 0). A zero has no sign: (-1, -0) is pi. Error < 1e-15.
[[nodiscard]] double detAtan2(double y, double x);
/// Angle in 0..pi whose cosine is x; x is clamped to -1..1. Error < 1e-15.
[[nodiscard]] double detAcos(double x);

} // namespace elastoon
