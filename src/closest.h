// The closest points of two posed solids, by either of two methods that tests hold equal. docs/vclip.md.
#pragma once

#include "elastoon/shape.h"
#include "topology.h"

#include <array>
#include <cstdint>

namespace elastoon {

/// world = position + linear * X for a point X of the shape; the determinant of `linear` is positive.
struct PosedShape {
    const Shape* shape = nullptr;
    Mat3 linear{1.0};
    Vec3 position{0.0};
};

struct Feature {
    enum class Kind : std::uint8_t { Vertex, Edge, Face };
    Kind kind = Kind::Vertex;
    std::uint32_t index = 0;
    friend bool operator==(const Feature&, const Feature&) = default;
};

/// Where the last query of the same two bodies ended. It speeds the next one and does not change what it finds.
/// The default knows nothing.
struct ClosestSeed {
    bool has_features = false; ///< of the last disjoint pose
    std::uint8_t pair_count = 0;
    Feature a, b;
    std::array<std::uint32_t, 4> pairs_a{}; ///< vertices whose differences made the last simplex
    std::array<std::uint32_t, 4> pairs_b{};
};

struct Closest {
    bool overlap = false;
    /// 0 on overlap. Less than about 1e-15 of the size is overlap.
    double distance = 0.0;
    Vec3 point_a{0.0}, point_b{0.0};
    /// Unit, from b towards a: from the features where the distance is too small to give a direction. Zero on overlap.
    Vec3 normal{0.0};
    Feature feature_a, feature_b;
    /// On overlap, a point of both.
    Vec3 witness{0.0};
};

enum class ClosestMethod : std::uint8_t { Vclip, Gjk };

[[nodiscard]] Closest closestPoints(const PosedShape& a, const PosedShape& b, ClosestSeed& seed,
                                    ClosestMethod method = ClosestMethod::Vclip);

/// About the greatest distance of a point of the body from its own position: at most so far.
[[nodiscard]] double sizeBound(const PosedShape& body);

/// Rounding of a difference of points of the two bodies is about this times 1e-16.
[[nodiscard]] double roundingScale(const PosedShape& a, const PosedShape& b);

} // namespace elastoon
