// Which vertices, edges and faces of a polytope meet. Incidence survives every affine map, so it is built once a shape.
#pragma once

#include "elastoon/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace elastoon {

struct Topology {
    static constexpr std::uint32_t kNone = 0xffffffff;

    /// The left face has tail -> head in its counter-clockwise loop, the right face head -> tail.
    struct Edge {
        std::uint32_t tail, head;
        std::uint32_t left, right;
    };
    std::vector<Edge> edges;

    /// Vertex v has the edges vertex_edges[vertex_begin[v] .. vertex_begin[v + 1]]; neighbors, in the same order, holds
    /// their other ends.
    std::vector<std::uint32_t> vertex_begin;
    std::vector<std::uint32_t> vertex_edges;
    std::vector<std::uint32_t> neighbors;
    std::vector<Vec3> ways; ///< in the same order, the way to the other end

    /// Face f has the edges face_edges[face_begin[f] .. face_begin[f + 1]]; edge i joins vertices i and i + 1 of its
    /// loop.
    std::vector<std::uint32_t> face_begin;
    std::vector<std::uint32_t> face_edges;

    /// Outward, unit, in the shape's frame.
    std::vector<Vec3> face_normals;

    /// Every edge has two faces and the whole is one closed surface. Walks over the surface need it.
    bool closed = false;
    /// Climbing ends at the top. Not so where hulls are convex only to within their play, and edges so short that the
    /// play tilts them.
    bool climbable = false;

    [[nodiscard]] std::span<const std::uint32_t> edgesOfVertex(std::uint32_t vertex) const {
        return {vertex_edges.data() + vertex_begin[vertex], vertex_edges.data() + vertex_begin[vertex + 1]};
    }
    [[nodiscard]] std::span<const std::uint32_t> neighborsOf(std::uint32_t vertex) const {
        return {neighbors.data() + vertex_begin[vertex], neighbors.data() + vertex_begin[vertex + 1]};
    }
    [[nodiscard]] std::span<const std::uint32_t> edgesOfFace(std::uint32_t face) const {
        return {face_edges.data() + face_begin[face], face_edges.data() + face_begin[face + 1]};
    }
};

/// Face i has the vertices face_vertices[face_begin[i] .. face_begin[i + 1]], counter-clockwise from outside.
[[nodiscard]] Topology topologyOf(std::span<const Vec3> vertices, std::span<const std::uint32_t> face_vertices,
                                  std::span<const std::uint32_t> face_begin);

/// The vertex furthest in `direction` (shape frame, any length), by climbing from `start`.
[[nodiscard]] std::uint32_t climb(std::span<const Vec3> vertices, const Topology& topology, const Vec3& direction,
                                  std::uint32_t start);

inline std::uint32_t climb(std::span<const Vec3> vertices, const Topology& topology, const Vec3& direction,
                           std::uint32_t start) {
    std::uint32_t best = start;
    if (!topology.climbable) {
        for (std::uint32_t i = 0; i < vertices.size(); ++i) {
            best = glm::dot(direction, vertices[i] - vertices[best]) > 0.0 ? i : best;
        }
        return best;
    }
    // Differences, not heights: a short edge keeps its slope. Rounding could make the climb go round; it is bounded.
    for (std::size_t steps = vertices.size(); steps > 0; --steps) {
        const std::uint32_t end = topology.vertex_begin[best + 1];
        std::uint32_t steepest = end;
        double rise = 0.0;
        for (std::uint32_t i = topology.vertex_begin[best]; i < end; ++i) {
            const double up = glm::dot(direction, topology.ways[i]);
            if (up > rise) {
                rise = up;
                steepest = i;
            }
        }
        if (steepest == end) {
            break;
        }
        best = topology.neighbors[steepest];
    }
    return best;
}

} // namespace elastoon
