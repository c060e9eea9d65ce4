// The vertex of a shape that lies furthest in a direction: by looking at all of few, by climbing among many.
#pragma once

#include "elastoon/shape.h"
#include "topology.h"

namespace elastoon {

/// Shape::supportVertex, for loops that cannot afford the call.
[[nodiscard]] inline std::size_t supportOf(const Shape& shape, const Vec3& direction) {
    const auto vertices = shape.vertices();
    const ClimbStarts& starts = shape.climbStarts();
    if (!starts.empty()) {
        return climb(vertices, shape.topology(), direction, starts.near(direction));
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

} // namespace elastoon
