// What a shape is made from, to the bit: for snapshots that carry their shapes.
#pragma once

#include "byte_stream.h"
#include "elastoon/shape.h"
#include "hull.h"

#include <optional>

namespace elastoon {

struct ShapeParts {
    ShapeKind kind = ShapeKind::Hull;
    double radius = 0.0;
    double volume = 0.0;
    Vec3 centroid_of_input{0.0};
    Polytope polytope; ///< about its centroid

    [[nodiscard]] static ShapeParts of(const Shape& shape);
    /// What keeps these parts from being a closed convex solid; none where they are one.
    [[nodiscard]] std::optional<Error> flaw() const;
    /// The shape; the parts must be without a flaw.
    [[nodiscard]] static ShapePtr toShape(ShapeParts parts) { return Shape::fromParts(std::move(parts)); }
};

template <class Stream, class Parts>
void shapeFields(Stream& stream, Parts& parts) {
    stream(parts.kind, parts.radius, parts.volume, parts.centroid_of_input);
    auto& polytope = parts.polytope;
    stream.sized(polytope.vertices, 24);
    for (auto& vertex : polytope.vertices) {
        stream(vertex);
    }
    stream.sized(polytope.face_vertices, 4);
    for (auto& vertex : polytope.face_vertices) {
        stream(vertex);
    }
    stream.sized(polytope.face_begin, 4);
    for (auto& begin : polytope.face_begin) {
        stream(begin);
    }
}

} // namespace elastoon
