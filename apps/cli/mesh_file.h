// Mesh files (.obj, .stl, .ply, .glb and whatever else assimp reads): their surface, and what their convex hull adds.
#pragma once

#include "elastoon/math.h"
#include "elastoon/result.h"
#include "isolated.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace elastoon {

/// Triangles over points that all differ and are all finite, as the file has them: no unit and no axis is changed.
struct TriangleMesh {
    using Triangle = std::array<std::uint32_t, 3>;
    std::vector<Vec3> points; ///< m
    std::vector<Triangle> triangles;
};

/// The same surface with equal points made one, without points that no triangle has. Error: an index that is none, a
/// point that is not finite, no triangle.
[[nodiscard]] Result<TriangleMesh> welded(std::span<const Vec3> points,
                                          std::span<const TriangleMesh::Triangle> triangles);

/// The mesh file, with the transforms of its nodes applied. assimp reads it in a process of its own: a file that makes
/// it crash, hang or take all memory is an error like any other. Errors name the file. The limits are those of a small
/// file; they grow with its size.
[[nodiscard]] Result<TriangleMesh> readMesh(const std::string& path, const IsolationLimits& limits = {});

enum class Closedness : std::uint8_t { Closed, Open, Unoriented };
/// Open: an edge that an odd number of triangles meet at. Unoriented: else an edge whose triangles do not cancel.
[[nodiscard]] Closedness closednessOf(const TriangleMesh& mesh);
/// m^3, of a closed mesh, inside out or not. Where its parts overlap, the overlap counts again.
[[nodiscard]] double volumeOf(const TriangleMesh& mesh);

/// One line about what the hull, of the volume given, adds to the mesh, or why that is not known. Empty where the hull
/// adds less than 0.1 %.
[[nodiscard]] std::string hullNote(const std::string& shape, const std::string& file, const TriangleMesh& mesh,
                                   double hull_volume);

/// For the way between processes.
[[nodiscard]] std::string packed(const TriangleMesh& mesh);
[[nodiscard]] Result<TriangleMesh> unpacked(const std::string& bytes);

} // namespace elastoon
