// The surface that is drawn for a shape: fine, smooth-shaded, with a pattern that makes squash, stretch and rolling
// readable. Finer than the polytope that collides. Used by pictures and by .glb files.
#pragma once

#include "elastoon/shape.h"

#include <array>
#include <cstdint>
#include <vector>

namespace elastoon {

/// Which of the body's colours a triangle has.
enum class Tint : std::uint8_t {
    Main,   ///< the body's colour
    Light,  ///< near white, the other stripe
    Accent, ///< a darker shade of the body's colour: caps and rings
};
inline constexpr std::size_t kTintCount = 3;

/// Triangles in the shape's frame (m), counter-clockwise seen from outside. A vertex on a sharp edge or on a border
/// between tints stands there once for each side.
struct DrawnMesh {
    std::vector<std::array<float, 3>> positions;
    std::vector<std::array<float, 3>> normals; ///< unit, same count as positions
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<Tint> tints; ///< one for each triangle
};

/// The drawn surface of a shape. Round kinds are tessellated from their true surfaces; hulls and boxes are flat-faced.
/// `patterned` false: everything is Tint::Main (obstacles).
[[nodiscard]] DrawnMesh drawnMesh(const Shape& shape, bool patterned);

/// The sRGB colour (0..1) of a tint, for a body of this colour.
[[nodiscard]] Vec3 tintColor(Tint tint, const Vec3& body_color);

} // namespace elastoon
