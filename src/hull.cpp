// Based on: Barber, Dobkin, Huhdanpaa, "The Quickhull Algorithm for Convex Hulls", 1996. It deviates in merging
// coplanar facets once, at the end, instead of on the way.
#include "hull.h"

#include "elastoon/shape.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace elastoon {

namespace {

constexpr int kNone = -1;
/// In units of the set's size.
constexpr double kOnPlane = 1e-13;
constexpr double kCoplanar = 1e-11;
constexpr double kFlat = 1e-10;

struct Facet {
    std::array<int, 3> vertices{};
    std::array<int, 3> neighbors{kNone, kNone, kNone}; ///< across the edge vertices[i] -> vertices[i + 1]
    Vec3 normal{0.0};
    double offset = 0.0;
    double area = 0.0; ///< doubled
    std::vector<int> outside;
    int furthest = kNone;
    double furthest_distance = 0.0;
    bool alive = true;
    int seen_by = kNone;

    [[nodiscard]] double distance(const Vec3& point) const { return glm::dot(normal, point) - offset; }
};

/// Edge on the border of what a point sees: `facet` stays, its edge number `edge` gets a new neighbour.
struct HorizonEdge {
    int from, to;
    int facet, edge;
};

class Quickhull {
public:
    explicit Quickhull(std::vector<Vec3> points) : points_(std::move(points)) {}

    /// What the points span, if not a solid.
    const char* begin();
    void run();
    [[nodiscard]] const std::vector<Facet>& facets() const { return facets_; }
    [[nodiscard]] const std::vector<Vec3>& points() const { return points_; }

private:
    int addFacet(int a, int b, int c);
    void link(int facet, int edge, int other, int other_edge);
    void giveTo(const std::vector<int>& candidates, std::size_t first_facet);
    [[nodiscard]] std::vector<HorizonEdge> horizonOf(int eye, int start, std::vector<int>& seen);
    bool addPoint(int eye, int start);
    void dropFurthest(Facet& facet);

    std::vector<Vec3> points_;
    std::vector<Facet> facets_;
};

int Quickhull::addFacet(int a, int b, int c) {
    Facet facet;
    facet.vertices = {a, b, c};
    const auto at = [&](int i) { return points_[static_cast<std::size_t>(i)]; };
    const Vec3 cross = glm::cross(at(b) - at(a), at(c) - at(a));
    facet.area = glm::length(cross);
    facet.normal = facet.area > 0.0 ? cross / facet.area : Vec3(0.0);
    facet.offset = glm::dot(facet.normal, (at(a) + at(b) + at(c)) / 3.0);
    facets_.push_back(std::move(facet));
    return static_cast<int>(facets_.size()) - 1;
}

void Quickhull::link(int facet, int edge, int other, int other_edge) {
    facets_[static_cast<std::size_t>(facet)].neighbors[static_cast<std::size_t>(edge)] = other;
    facets_[static_cast<std::size_t>(other)].neighbors[static_cast<std::size_t>(other_edge)] = facet;
}

void Quickhull::giveTo(const std::vector<int>& candidates, std::size_t first_facet) {
    for (const int candidate : candidates) {
        const Vec3& point = points_[static_cast<std::size_t>(candidate)];
        for (std::size_t i = first_facet; i < facets_.size(); ++i) {
            Facet& facet = facets_[i];
            const double distance = facet.distance(point);
            if (distance > kOnPlane) {
                facet.outside.push_back(candidate);
                if (distance > facet.furthest_distance) {
                    facet.furthest_distance = distance;
                    facet.furthest = candidate;
                }
                break;
            }
        }
    }
}

const char* Quickhull::begin() {
    const auto count = static_cast<int>(points_.size());
    const auto at = [&](int i) { return points_[static_cast<std::size_t>(i)]; };
    const auto furthestBy = [&](auto&& measure) {
        int best = 0;
        for (int i = 1; i < count; ++i) {
            best = measure(at(i)) > measure(at(best)) ? i : best;
        }
        return best;
    };
    const int a = furthestBy([](const Vec3& p) { return p.x + 0.618 * p.y + 0.377 * p.z; });
    const int b = furthestBy([&](const Vec3& p) { return glm::length(p - at(a)); });
    if (glm::length(at(b) - at(a)) < kFlat) {
        return "are all at one place";
    }
    const Vec3 along = glm::normalize(at(b) - at(a));
    const auto fromLine = [&](const Vec3& p) { return glm::length(glm::cross(along, p - at(a))); };
    const int c = furthestBy(fromLine);
    if (fromLine(at(c)) < kFlat) {
        return "lie on one line";
    }
    const Vec3 normal = glm::normalize(glm::cross(at(b) - at(a), at(c) - at(a)));
    const auto fromPlane = [&](const Vec3& p) { return std::fabs(glm::dot(normal, p - at(a))); };
    const int d = furthestBy(fromPlane);
    if (fromPlane(at(d)) < kFlat) {
        return "lie on one plane";
    }
    const bool above = glm::dot(normal, at(d) - at(a)) > 0.0;
    const int p = above ? c : b;
    const int q = above ? b : c;
    addFacet(a, p, q);
    addFacet(a, d, p);
    addFacet(p, d, q);
    addFacet(q, d, a);
    link(0, 0, 1, 2);
    link(0, 1, 2, 2);
    link(0, 2, 3, 2);
    link(1, 1, 2, 0);
    link(2, 1, 3, 0);
    link(3, 1, 1, 0);
    std::vector<int> others;
    for (int i = 0; i < count; ++i) {
        if (i != a && i != b && i != c && i != d) {
            others.push_back(i);
        }
    }
    giveTo(others, 0);
    return nullptr;
}

std::vector<HorizonEdge> Quickhull::horizonOf(int eye, int start, std::vector<int>& seen) {
    const Vec3 point = points_[static_cast<std::size_t>(eye)];
    std::vector<HorizonEdge> horizon;
    seen = {start};
    facets_[static_cast<std::size_t>(start)].seen_by = eye;
    for (std::size_t next = 0; next < seen.size(); ++next) {
        for (const int other : facets_[static_cast<std::size_t>(seen[next])].neighbors) {
            Facet& neighbor = facets_[static_cast<std::size_t>(other)];
            if (neighbor.seen_by == eye) {
                continue;
            }
            if (neighbor.distance(point) > kOnPlane) {
                neighbor.seen_by = eye;
                seen.push_back(other);
            }
        }
    }
    for (const int index : seen) {
        const Facet& facet = facets_[static_cast<std::size_t>(index)];
        for (std::size_t edge = 0; edge < 3; ++edge) {
            const int other = facet.neighbors[edge];
            const Facet& neighbor = facets_[static_cast<std::size_t>(other)];
            if (neighbor.seen_by != eye) {
                const auto back = std::find(neighbor.neighbors.begin(), neighbor.neighbors.end(), index);
                horizon.push_back({facet.vertices[edge], facet.vertices[(edge + 1) % 3], other,
                                   static_cast<int>(back - neighbor.neighbors.begin())});
            }
        }
    }
    return horizon;
}

/// False where rounding made the border of what the point sees something else than one loop.
bool chainLoop(std::vector<HorizonEdge>& horizon) {
    for (std::size_t i = 0; i + 1 < horizon.size(); ++i) {
        const auto next = std::find_if(horizon.begin() + static_cast<std::ptrdiff_t>(i) + 1, horizon.end(),
                                       [&](const HorizonEdge& edge) { return edge.from == horizon[i].to; });
        if (next == horizon.end()) {
            return false;
        }
        std::swap(horizon[i + 1], *next);
    }
    return horizon.size() >= 3 && horizon.back().to == horizon.front().from;
}

bool Quickhull::addPoint(int eye, int start) {
    std::vector<int> seen;
    std::vector<HorizonEdge> horizon = horizonOf(eye, start, seen);
    if (!chainLoop(horizon)) {
        for (const int index : seen) {
            facets_[static_cast<std::size_t>(index)].seen_by = kNone;
        }
        return false;
    }
    std::vector<int> orphans;
    for (const int index : seen) {
        Facet& facet = facets_[static_cast<std::size_t>(index)];
        facet.alive = false;
        for (const int point : facet.outside) {
            if (point != eye) {
                orphans.push_back(point);
            }
        }
        facet.outside = {};
    }
    const std::size_t first = facets_.size();
    for (const HorizonEdge& edge : horizon) {
        const int made = addFacet(edge.from, edge.to, eye);
        link(made, 0, edge.facet, edge.edge);
    }
    const auto count = static_cast<int>(horizon.size());
    for (int i = 0; i < count; ++i) {
        link(static_cast<int>(first) + i, 1, static_cast<int>(first) + (i + 1) % count, 2);
    }
    giveTo(orphans, first);
    return true;
}

void Quickhull::dropFurthest(Facet& facet) {
    std::erase(facet.outside, facet.furthest);
    facet.furthest = kNone;
    facet.furthest_distance = 0.0;
    for (const int point : facet.outside) {
        const double distance = facet.distance(points_[static_cast<std::size_t>(point)]);
        if (distance > facet.furthest_distance) {
            facet.furthest_distance = distance;
            facet.furthest = point;
        }
    }
}

void Quickhull::run() {
    for (std::size_t i = 0; i < facets_.size(); ++i) {
        while (facets_[i].alive && facets_[i].furthest != kNone) {
            if (!addPoint(facets_[i].furthest, static_cast<int>(i))) {
                dropFurthest(facets_[i]);
            }
        }
    }
}

/// Facets that lie on one plane, as loops of vertices.
class Merger {
public:
    explicit Merger(const Quickhull& hull) : facets_(hull.facets()), points_(hull.points()), face_of_(facets_.size()) {}
    [[nodiscard]] std::vector<std::vector<int>> loops();

private:
    void grow(int seed, int face, std::vector<int>& members);
    [[nodiscard]] std::vector<int> borderOf(const std::vector<int>& members, int face) const;

    const std::vector<Facet>& facets_;
    const std::vector<Vec3>& points_;
    std::vector<int> face_of_;
};

void Merger::grow(int seed, int face, std::vector<int>& members) {
    const Facet& plane = facets_[static_cast<std::size_t>(seed)];
    members = {seed};
    face_of_[static_cast<std::size_t>(seed)] = face;
    for (std::size_t next = 0; next < members.size(); ++next) {
        for (const int other : facets_[static_cast<std::size_t>(members[next])].neighbors) {
            if (face_of_[static_cast<std::size_t>(other)] != kNone) {
                continue;
            }
            const Facet& facet = facets_[static_cast<std::size_t>(other)];
            const bool coplanar = std::all_of(facet.vertices.begin(), facet.vertices.end(), [&](int vertex) {
                return std::fabs(plane.distance(points_[static_cast<std::size_t>(vertex)])) <= kCoplanar;
            });
            if (coplanar && (facet.area < kCoplanar || glm::dot(facet.normal, plane.normal) > 0.0)) {
                face_of_[static_cast<std::size_t>(other)] = face;
                members.push_back(other);
            }
        }
    }
}

std::vector<int> Merger::borderOf(const std::vector<int>& members, int face) const {
    std::vector<std::array<int, 2>> edges;
    for (const int index : members) {
        const Facet& facet = facets_[static_cast<std::size_t>(index)];
        for (std::size_t edge = 0; edge < 3; ++edge) {
            if (face_of_[static_cast<std::size_t>(facet.neighbors[edge])] != face) {
                edges.push_back({facet.vertices[edge], facet.vertices[(edge + 1) % 3]});
            }
        }
    }
    std::vector<int> loop{edges.front()[0]};
    while (loop.size() < edges.size()) {
        const auto next = std::find_if(edges.begin(), edges.end(), [&](const auto& e) { return e[0] == loop.back(); });
        if (next == edges.end() || (*next)[1] == loop.front()) {
            break;
        }
        loop.push_back((*next)[1]);
    }
    return loop;
}

std::vector<std::vector<int>> Merger::loops() {
    std::fill(face_of_.begin(), face_of_.end(), kNone);
    std::vector<int> order;
    for (std::size_t i = 0; i < facets_.size(); ++i) {
        if (facets_[i].alive) {
            order.push_back(static_cast<int>(i));
        }
    }
    // The largest facets have the most trustworthy planes.
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        return facets_[static_cast<std::size_t>(a)].area > facets_[static_cast<std::size_t>(b)].area;
    });
    std::vector<std::vector<int>> faces;
    std::vector<int> members;
    for (const int seed : order) {
        if (face_of_[static_cast<std::size_t>(seed)] == kNone) {
            grow(seed, static_cast<int>(faces.size()), members);
            faces.push_back(borderOf(members, static_cast<int>(faces.size())));
        }
    }
    return faces;
}

/// Keeps the vertices where three faces or more meet: the others lie on straight edges.
Polytope compact(std::span<const Vec3> points, const std::vector<std::vector<int>>& loops) {
    std::vector<int> uses(points.size(), 0);
    for (const auto& loop : loops) {
        for (const int vertex : loop) {
            ++uses[static_cast<std::size_t>(vertex)];
        }
    }
    Polytope polytope;
    std::vector<std::uint32_t> number(points.size(), 0);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (uses[i] >= 3) {
            number[i] = static_cast<std::uint32_t>(polytope.vertices.size());
            polytope.vertices.push_back(points[i]);
        }
    }
    for (const auto& loop : loops) {
        const std::size_t begin = polytope.face_vertices.size();
        for (const int vertex : loop) {
            if (uses[static_cast<std::size_t>(vertex)] >= 3) {
                polytope.face_vertices.push_back(number[static_cast<std::size_t>(vertex)]);
            }
        }
        if (polytope.face_vertices.size() - begin < 3) {
            polytope.face_vertices.resize(begin);
        } else {
            polytope.face_begin.push_back(static_cast<std::uint32_t>(polytope.face_vertices.size()));
        }
    }
    return polytope;
}

} // namespace

Result<Polytope> convexHull(std::span<const Vec3> points) {
    if (points.size() < 4) {
        return Error{"a solid needs at least 4 points, there are " + std::to_string(points.size()), ""};
    }
    Vec3 low = points.front();
    Vec3 high = low;
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            if (!(std::fabs(points[i][axis]) <= Shape::kMaxSize)) {
                return Error{"point " + std::to_string(i) + " is not finite, or further than 1e9 m from the origin",
                             ""};
            }
        }
        low = glm::min(low, points[i]);
        high = glm::max(high, points[i]);
    }
    const double size = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    if (size < Shape::kMinSize) {
        return Error{"the points lie within 1e-9 m of each other; a solid must be larger", ""};
    }
    const Vec3 center = 0.5 * (low + high);
    std::vector<Vec3> scaled;
    scaled.reserve(points.size());
    for (const Vec3& point : points) {
        scaled.push_back((point - center) / size);
    }
    Quickhull hull(std::move(scaled));
    if (const char* what = hull.begin()) {
        return Error{std::string("the points ") + what + "; a solid must have a volume", ""};
    }
    hull.run();
    Polytope polytope = compact(points, Merger(hull).loops());
    if (polytope.vertices.size() < 4 || polytope.face_begin.size() < 5) {
        return Error{"the points are too nearly flat for a solid", ""};
    }
    return polytope;
}

MassCenter massCenterOf(const Polytope& polytope) {
    const Vec3 base = polytope.vertices.front();
    double volume = 0.0;
    Vec3 moment(0.0);
    for (std::size_t face = 0; face + 1 < polytope.face_begin.size(); ++face) {
        const std::uint32_t begin = polytope.face_begin[face];
        const auto corner = [&](std::uint32_t i) {
            return polytope.vertices[polytope.face_vertices[begin + i]] - base;
        };
        for (std::uint32_t i = 1; begin + i + 1 < polytope.face_begin[face + 1]; ++i) {
            const double part = glm::dot(corner(0), glm::cross(corner(i), corner(i + 1)));
            volume += part;
            moment += part * (corner(0) + corner(i) + corner(i + 1));
        }
    }
    return {volume / 6.0, base + moment / (4.0 * volume)};
}

} // namespace elastoon
