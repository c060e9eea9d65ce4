// Sixteen bodies side by side: what their matrices are made from, a lane for each, so that they are worked out at once.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace elastoon {

inline constexpr std::size_t kLanes = 16;
using Row = std::array<double, kLanes>;

inline constexpr std::size_t kMatrixFloats = 12;
/// Of each lane the columns of the linear part, then the position; number by number.
using Columns = std::array<std::array<float, kLanes>, kMatrixFloats>;

/// A rotation of one lane. glm's own product has the same order, but is no loop that the compiler turns into one of
/// many.
struct LaneTurn {
    double w, x, y, z;
};

[[gnu::always_inline]] inline LaneTurn operator*(const LaneTurn& p, const LaneTurn& q) {
    return {p.w * q.w - p.x * q.x - p.y * q.y - p.z * q.z, p.w * q.x + p.x * q.w + p.y * q.z - p.z * q.y,
            p.w * q.y + p.y * q.w + p.z * q.x - p.x * q.z, p.w * q.z + p.z * q.w + p.x * q.y - p.y * q.x};
}

/// The linear part of one lane's pose, as linearOf() has it, to the bit.
[[gnu::always_inline]] inline void putLinear(const LaneTurn& turn, double stretch, std::size_t i, Columns& out) {
    const double w = turn.w, x = turn.x, y = turn.y, z = turn.z;
    const double thin = 1.0 / std::sqrt(stretch);
    const double xx = x * x, yy = y * y, zz = z * z, xz = x * z, xy = x * y, yz = y * z;
    const double wqx = w * x, wqy = w * y, wqz = w * z;
    out[0][i] = static_cast<float>((1.0 - 2.0 * (yy + zz)) * stretch);
    out[1][i] = static_cast<float>(2.0 * (xy + wqz) * stretch);
    out[2][i] = static_cast<float>(2.0 * (xz - wqy) * stretch);
    out[3][i] = static_cast<float>(2.0 * (xy - wqz) * thin);
    out[4][i] = static_cast<float>((1.0 - 2.0 * (xx + zz)) * thin);
    out[5][i] = static_cast<float>(2.0 * (yz + wqx) * thin);
    out[6][i] = static_cast<float>(2.0 * (xz + wqy) * thin);
    out[7][i] = static_cast<float>(2.0 * (yz - wqx) * thin);
    out[8][i] = static_cast<float>((1.0 - 2.0 * (xx + yy)) * thin);
}

} // namespace elastoon
