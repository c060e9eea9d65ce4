// Edges out of face loops, by sorting; and the climb over them. See topology.h.
#include "topology.h"

#include <algorithm>

namespace elastoon {

namespace {

/// A face's step from one vertex to the next.
struct HalfEdge {
    std::uint32_t low, high;
    bool forward; ///< from low to high
    std::uint32_t face, slot;
};

std::vector<HalfEdge> halfEdgesOf(std::span<const std::uint32_t> face_vertices,
                                  std::span<const std::uint32_t> face_begin) {
    std::vector<HalfEdge> halves;
    halves.reserve(face_vertices.size());
    for (std::uint32_t face = 0; face + 1 < face_begin.size(); ++face) {
        for (std::uint32_t slot = face_begin[face]; slot < face_begin[face + 1]; ++slot) {
            const std::uint32_t next = slot + 1 < face_begin[face + 1] ? slot + 1 : face_begin[face];
            const std::uint32_t from = face_vertices[slot];
            const std::uint32_t to = face_vertices[next];
            halves.push_back({std::min(from, to), std::max(from, to), from < to, face, slot});
        }
    }
    std::sort(halves.begin(), halves.end(), [](const HalfEdge& p, const HalfEdge& q) {
        return p.low != q.low ? p.low < q.low : p.high != q.high ? p.high < q.high : p.slot < q.slot;
    });
    return halves;
}

/// Newell's normal: exact enough for slivers and polygons alike.
Vec3 normalOf(std::span<const Vec3> vertices, std::span<const std::uint32_t> loop) {
    const Vec3 base = vertices[loop[0]];
    Vec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
        sum += glm::cross(vertices[loop[i]] - base, vertices[loop[i + 1]] - base);
    }
    // Scaled first: the square of a tiny shape's area could vanish.
    const Vec3 magnitude = glm::abs(sum);
    const double largest = std::max({magnitude.x, magnitude.y, magnitude.z});
    return largest > 0.0 ? glm::normalize(sum / largest) : Vec3(0.0);
}

void linkVertices(Topology& topology, std::size_t vertex_count) {
    topology.vertex_begin.assign(vertex_count + 1, 0);
    for (const Topology::Edge& edge : topology.edges) {
        ++topology.vertex_begin[edge.tail + 1];
        ++topology.vertex_begin[edge.head + 1];
    }
    for (std::size_t i = 0; i < vertex_count; ++i) {
        topology.vertex_begin[i + 1] += topology.vertex_begin[i];
    }
    topology.vertex_edges.resize(2 * topology.edges.size());
    topology.neighbors.resize(2 * topology.edges.size());
    std::vector<std::uint32_t> next(topology.vertex_begin.begin(), topology.vertex_begin.end() - 1);
    for (std::uint32_t i = 0; i < topology.edges.size(); ++i) {
        const Topology::Edge& edge = topology.edges[i];
        topology.vertex_edges[next[edge.tail]] = i;
        topology.neighbors[next[edge.tail]++] = edge.head;
        topology.vertex_edges[next[edge.head]] = i;
        topology.neighbors[next[edge.head]++] = edge.tail;
    }
}

/// Whether no edge bends inwards by more than rounding, or none is short.
bool isClimbable(const Topology& topology, std::span<const Vec3> vertices, std::span<const std::uint32_t> face_vertices,
                 std::span<const std::uint32_t> face_begin) {
    constexpr double kShortEdge = 1e-3;
    constexpr double kRounding = 1e-14;
    double size = 0.0;
    for (const Vec3& vertex : vertices) {
        size = std::max(size, glm::length(vertex));
    }
    double shortest = size;
    for (const Topology::Edge& edge : topology.edges) {
        shortest = std::min(shortest, glm::length(vertices[edge.head] - vertices[edge.tail]));
    }
    if (shortest >= kShortEdge * size) {
        return true;
    }
    for (const Topology::Edge& edge : topology.edges) {
        for (std::uint32_t i = face_begin[edge.right]; i < face_begin[edge.right + 1]; ++i) {
            const Vec3 from_edge = vertices[face_vertices[i]] - vertices[edge.tail];
            if (glm::dot(topology.face_normals[edge.left], from_edge) > kRounding * size) {
                return false;
            }
        }
    }
    return true;
}

} // namespace

Topology topologyOf(std::span<const Vec3> vertices, std::span<const std::uint32_t> face_vertices,
                    std::span<const std::uint32_t> face_begin) {
    Topology topology;
    topology.face_begin.assign(face_begin.begin(), face_begin.end());
    topology.face_edges.assign(face_vertices.size(), Topology::kNone);
    topology.closed = true;
    const std::vector<HalfEdge> halves = halfEdgesOf(face_vertices, face_begin);
    for (std::size_t i = 0; i < halves.size();) {
        std::size_t end = i + 1;
        while (end < halves.size() && halves[end].low == halves[i].low && halves[end].high == halves[i].high) {
            ++end;
        }
        Topology::Edge edge{halves[i].low, halves[i].high, Topology::kNone, Topology::kNone};
        for (std::size_t k = i; k < end; ++k) {
            (halves[k].forward ? edge.left : edge.right) = halves[k].face;
            topology.face_edges[halves[k].slot] = static_cast<std::uint32_t>(topology.edges.size());
        }
        const bool paired = end - i == 2 && edge.left != Topology::kNone && edge.right != Topology::kNone;
        topology.closed = topology.closed && paired;
        topology.edges.push_back(edge);
        i = end;
    }
    linkVertices(topology, vertices.size());
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        for (const std::uint32_t neighbor : topology.neighborsOf(static_cast<std::uint32_t>(v))) {
            topology.ways.push_back(vertices[neighbor] - vertices[v]);
        }
    }
    for (std::size_t face = 0; face + 1 < face_begin.size(); ++face) {
        topology.face_normals.push_back(
            normalOf(vertices, face_vertices.subspan(face_begin[face], face_begin[face + 1] - face_begin[face])));
    }
    topology.closed = topology.closed && vertices.size() + topology.face_normals.size() == topology.edges.size() + 2;
    topology.climbable = topology.closed && isClimbable(topology, vertices, face_vertices, face_begin);
    return topology;
}

} // namespace elastoon
