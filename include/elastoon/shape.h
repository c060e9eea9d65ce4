// Convex shapes: polytopes about their volume centroid, principal axis along x, with exact extents along the axes.
#pragma once

#include "elastoon/export.h"
#include "elastoon/math.h"
#include "elastoon/result.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace elastoon ELASTOON_API {

class Shape;
struct Topology;
struct ShapeParts;
class SupportTable;
/// Shapes are immutable and shared between worlds and bodies.
using ShapePtr = std::shared_ptr<const Shape>;

enum class ShapeKind : std::uint8_t { Sphere, Box, Cylinder, Cone, Capsule, Hull };

[[nodiscard]] std::string_view nameOf(ShapeKind kind);

/// A convex polytope. Vertices are in the shape's frame: origin at the volume centroid, principal axis along x.
/// Sizes must be finite and within kMinSize..kMaxSize, else the maker returns an error.
class Shape {
public:
    static constexpr double kMinSize = 1e-9;
    static constexpr double kMaxSize = 1e9;

    /// Ball of `radius` m: an octahedron's faces cut in `cuts` (a multiple of 2, 2..64) and drawn out to the ball:
    /// 4 cuts^2 + 2 vertices, among them those at +-radius on all three axes. The default has 258.
    static Result<ShapePtr> sphere(double radius, int cuts = 8);
    /// Box with full edge lengths `size`, m.
    static Result<ShapePtr> box(const Vec3& size);
    /// Cylinder along x, m; `sides` a multiple of 4, 8..256.
    static Result<ShapePtr> cylinder(double radius, double length, int sides = 32);
    /// Cone along x, its tip towards +x, m; `sides` a multiple of 4, 8..256.
    static Result<ShapePtr> cone(double radius, double length, int sides = 32);
    /// Capsule along x: `length` from tip to tip, at least 2 radius, m; `sides` a multiple of 4, 8..64.
    static Result<ShapePtr> capsule(double radius, double length, int sides = 16);
    /// Convex hull of points in m, moved so that its centroid is the origin. x stays the principal axis.
    /// Points that span no volume are an error that says what they span.
    static Result<ShapePtr> hull(std::span<const Vec3> points);

    [[nodiscard]] ShapeKind kind() const { return kind_; }
    [[nodiscard]] std::span<const Vec3> vertices() const { return vertices_; }

    [[nodiscard]] std::size_t faceCount() const { return face_begin_.size() - 1; }
    /// Indices of a face's vertices, counter-clockwise seen from outside. Coplanar neighbours are one face.
    [[nodiscard]] std::span<const std::uint32_t> face(std::size_t index) const;

    /// L: full extent along the principal axis, m.
    [[nodiscard]] double length() const { return length_; }
    /// Full extents along x, y, z, m.
    [[nodiscard]] const Vec3& extents() const { return extents_; }
    /// Greatest distance of a vertex from the centroid, m.
    [[nodiscard]] double boundingRadius() const { return bounding_radius_; }
    /// Greatest |x| of a vertex and greatest distance of a vertex from the x axis, m: they bound every stretch of it.
    [[nodiscard]] double reachAlong() const { return reach_along_; }
    [[nodiscard]] double reachAcross() const { return reach_across_; }
    /// m^3; a deformation does not change it.
    [[nodiscard]] double volume() const { return volume_; }
    /// Where the centroid lay in the coordinates that hull() was given; zero for the other kinds.
    [[nodiscard]] const Vec3& centroidOfInput() const { return centroid_of_input_; }

    /// Radius and length that the shape was made with (sphere: radius; cylinder, cone, capsule: both), else 0.
    [[nodiscard]] double radius() const { return radius_; }

    /// 64 bits over all that the shape is: shapes that were made alike have equal hashes, on every machine.
    [[nodiscard]] std::uint64_t contentHash() const { return content_hash_; }

    /// The vertex furthest in `direction` (shape frame, any length), to rounding.
    [[nodiscard]] std::size_t supportVertex(const Vec3& direction) const;

    /// Edges, and what meets what: for the library's own collision.
    [[nodiscard]] const Topology& topology() const { return *topology_; }
    /// Where supportVertex() looks: likewise.
    [[nodiscard]] const SupportTable& supportTable() const { return *support_table_; }

private:
    friend struct ShapeParts;
    Shape() = default;
    static ShapePtr fromParts(ShapeParts parts);
    static Result<ShapePtr> fromPoints(ShapeKind kind, std::vector<Vec3> points, double radius);

    ShapeKind kind_ = ShapeKind::Hull;
    std::vector<Vec3> vertices_;
    std::vector<std::uint32_t> face_vertices_;
    std::vector<std::uint32_t> face_begin_;
    std::shared_ptr<const Topology> topology_;
    std::shared_ptr<const SupportTable> support_table_;
    Vec3 extents_{0.0};
    Vec3 centroid_of_input_{0.0};
    double length_ = 0.0, bounding_radius_ = 0.0, reach_along_ = 0.0, reach_across_ = 0.0;
    double volume_ = 0.0, radius_ = 0.0;
    std::uint64_t content_hash_ = 0;
};

} // namespace elastoon ELASTOON_API
