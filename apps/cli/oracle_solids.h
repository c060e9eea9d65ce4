// Separation of two convex solids by brute force over all candidate axes, for the oracle.
#pragma once

#include "elastoon/math.h"
#include "elastoon/shape.h"

#include <array>
#include <cstdint>
#include <vector>

namespace elastoon {

using Real = long double;
using RealVec = std::array<Real, 3>;
using RealMat = std::array<RealVec, 3>; ///< rows

[[nodiscard]] RealMat rotationOf(const Quat& q);
[[nodiscard]] RealVec product(const RealMat& m, const RealVec& x);

/// Faces and edges of a solid, found anew from its face loops.
class SolidWitness {
public:
    explicit SolidWitness(const Shape& shape);

    struct Edge {
        std::uint32_t tail, head;
        std::size_t left, right; ///< faces
    };
    std::vector<std::vector<std::uint32_t>> faces;
    std::vector<Edge> edges;
};

/// A solid with its vertices where they are in the world.
struct PosedWitness {
    const SolidWitness* solid;
    std::vector<RealVec> vertices;
};

/// The shape's vertices stretched, turned and moved, in extended precision.
[[nodiscard]] std::vector<RealVec> posedVertices(const Shape& shape, const Pose& pose);

/// Least distance that two sets of points can have, by their boxes.
[[nodiscard]] Real boxGap(const std::vector<RealVec>& a, const std::vector<RealVec>& b);

/// Greatest gap between the two along any axis that can be the separating one: all face normals, and the cross products
/// of those edge pairs that make a face of the Minkowski difference. Positive: they are at least that far apart;
/// negative: they overlap, and the shortest way out is that long. (Separating axis theorem; edge pairs by their Gauss
/// arcs.)
[[nodiscard]] Real separationBySat(const PosedWitness& a, const PosedWitness& b);

} // namespace elastoon
