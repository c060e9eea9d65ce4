// The vertex of a shape that lies furthest in a direction: by looking at all of few, by a table of many.
#pragma once

#include "elastoon/shape.h"
#include "support_table.h"

namespace elastoon {

/// Shape::supportVertex, for loops that cannot afford the call.
[[nodiscard]] inline std::size_t supportOf(const Shape& shape, const Vec3& direction) {
    const auto vertices = shape.vertices();
    const SupportTable& table = shape.supportTable();
    if (!table.empty()) {
        return table.furthest(vertices, shape.topology(), direction);
    }
    std::size_t best = 0;
    double furthest = glm::dot(direction, vertices[0]);
    for (std::size_t i = 1; i < vertices.size(); ++i) {
        const double reach = glm::dot(direction, vertices[i]);
        if (reach > furthest) {
            furthest = reach;
            best = i;
        }
    }
    return best;
}

/// How far the shape reaches from its centroid in `direction`, times that direction's length.
[[nodiscard]] inline double reachOf(const Shape& shape, const Vec3& direction) {
    const auto vertices = shape.vertices();
    const SupportTable& table = shape.supportTable();
    return table.empty() ? glm::dot(direction, vertices[supportOf(shape, direction)])
                         : table.highest(vertices, shape.topology(), direction);
}

} // namespace elastoon
