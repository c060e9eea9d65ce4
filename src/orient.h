// On which side of a plane a point is: the exact answer, whatever the points are.
#pragma once

#include "elastoon/math.h"

namespace elastoon {

/// (b - a) x (c - a) . (p - a), six times the volume of the tetrahedron: positive where a, b, c run counter-clockwise
/// seen from p. The sign is exact, zero included, and the value good to 1e-15 of itself. Coordinates must be zero or
/// within 1e-50..1e50 in magnitude.
[[nodiscard]] double orientExactly(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p);

/// The plane of three points, with the exact answer asked for only where rounding could change it.
class OrientedPlane {
public:
    OrientedPlane() = default;
    /// `extent`: the most that coordinates of two points differ by, along each axis.
    OrientedPlane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& extent);

    /// Twice the area of the triangle: what the values of this class are distances times of.
    [[nodiscard]] double length() const { return length_; }
    /// Across the plane, of that length; its rounding may be large for a triangle that is thin.
    [[nodiscard]] const Vec3& normal() const { return normal_; }
    /// Distance from the plane times length(), up to errorBound().
    [[nodiscard]] double roughly(const Vec3& p) const { return glm::dot(normal_, p - a_); }
    [[nodiscard]] double errorBound() const { return error_bound_; }
    [[nodiscard]] double exactly(const Vec3& p) const { return orientExactly(a_, b_, c_, p); }
    /// Strictly on the side that sees a, b, c counter-clockwise: exact.
    [[nodiscard]] bool sees(const Vec3& p) const {
        const double rough = roughly(p);
        return rough > error_bound_ || (rough >= -error_bound_ && exactly(p) > 0.0);
    }
    /// Distance from the plane times length(), good to 1e-13 of itself.
    [[nodiscard]] double valueAt(const Vec3& p) const {
        const double rough = roughly(p);
        return error_bound_ <= 1e-13 * std::fabs(rough) ? rough : exactly(p);
    }
    /// Distance from the plane, positive where sees(): off by no more than `play`, or exact.
    [[nodiscard]] double distance(const Vec3& p, double play) const {
        return (error_bound_ <= play * length_ ? roughly(p) : exactly(p)) / length_;
    }

private:
    Vec3 a_{0.0}, b_{0.0}, c_{0.0};
    Vec3 normal_{0.0};
    double length_ = 0.0;
    double error_bound_ = 0.0;
};

} // namespace elastoon
