// Based on: Barber, Dobkin, Huhdanpaa, "The Quickhull Algorithm for Convex Hulls", 1996. It deviates where that works
// with thick facets: which facets a point sees is decided exactly, so the border of what it sees is always one loop.
#include "quickhull.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace elastoon {

namespace {

constexpr int kNone = -1;
/// Thinner than this share of the size is flat.
constexpr double kFlat = 1e-10;

struct Facet {
    Triangle triangle;
    OrientedPlane plane;
    int first = kNone;     ///< the furthest of the points that it keeps, all above it; the others follow in next_
    double furthest = 0.0; ///< distance of that one, times the plane's length
    int seen_at = 0; ///< the last look at which it was seen
    bool waits = false;    ///< the furthest is outside by more than rounding
    bool alive = true;
};

enum class Side : std::uint8_t {
    Behind,
    Above,   ///< by no more than rounding
    Outside,
};

/// Edge on the border of what a point sees: `facet` stays, and its edge number `edge` gets a new neighbour.
struct HorizonEdge {
    int from, to;
    int facet, edge;
};

class Quickhull {
public:
    explicit Quickhull(const PointSet& set) : set_(set), next_(set.points.size(), kNone), new_at_(next_) {}
    TriangleHull run();

private:
    Facet& facet(int index) { return facets_[static_cast<std::size_t>(index)]; }
    const char* findFirst(std::array<int, 4>& corners) const;
    void begin(const std::array<int, 4>& corners);
    int addFacet(int a, int b, int c);
    void giveTo(int first_point, const std::vector<int>& facets);
    Side sideOf(const Facet& facet, int point, double& value) const;
    void keep(int index, int point, double value, Side side);
    bool giveOn();
    void look(int eye, int start);
    void addPoint(int start);
    [[nodiscard]] std::vector<Triangle> triangles() const;

    const PointSet& set_;
    std::vector<Facet> facets_;
    std::vector<int> free_;
    std::vector<int> waiting_; ///< facets that have points outside, if they still live
    std::vector<int> next_;    ///< by point
    std::vector<int> new_at_;  ///< by point: the new facet that begins there
    int looks_ = 0;
    std::vector<int> seen_;
    std::vector<int> made_;
    std::vector<HorizonEdge> horizon_;
};

/// Corners of a first tetrahedron, or what the points span. The distances are taken after projections across what is
/// already spanned, so that they are good to rounding for needles and slabs too.
const char* Quickhull::findFirst(std::array<int, 4>& corners) const {
    const auto furthestBy = [&](auto&& measure) {
        int best = 0;
        double most = -1e300;
        int i = 0;
        for (const Vec3& point : set_.points) {
            const double value = measure(point);
            if (value > most) {
                most = value;
                best = i;
            }
            ++i;
        }
        return best;
    };
    const double flat = std::max(kFlat * set_.size, 8.0 * set_.rounding);
    auto& [a, b, c, d] = corners;
    a = furthestBy([](const Vec3& p) { return p.x + 0.618 * p.y + 0.377 * p.z; });
    const Vec3 origin = set_.at(a);
    b = furthestBy([&](const Vec3& p) { return glm::length(p - origin); });
    if (glm::length(set_.at(b) - origin) < flat) {
        return "are all at one place";
    }
    const Vec3 along = glm::normalize(set_.at(b) - origin);
    const auto acrossLine = [&](const Vec3& p) {
        const Vec3 way = p - origin;
        return way - along * glm::dot(along, way);
    };
    c = furthestBy([&](const Vec3& p) { return glm::length(acrossLine(p)); });
    if (glm::length(acrossLine(set_.at(c))) < flat) {
        return "lie on one line";
    }
    const Vec3 normal = glm::cross(along, glm::normalize(acrossLine(set_.at(c))));
    const auto fromPlane = [&](const Vec3& p) { return std::fabs(glm::dot(normal, acrossLine(p))); };
    d = furthestBy(fromPlane);
    const double volume = orientExactly(set_.at(a), set_.at(b), set_.at(c), set_.at(d));
    if (fromPlane(set_.at(d)) < flat || volume == 0.0) {
        return "lie on one plane";
    }
    if (volume > 0.0) {
        std::swap(b, c); // d is to be behind a, b, c
    }
    return nullptr;
}

int Quickhull::addFacet(int a, int b, int c) {
    int index = static_cast<int>(facets_.size());
    if (free_.empty()) {
        facets_.emplace_back();
    } else {
        index = free_.back();
        free_.pop_back();
        facet(index) = Facet{};
    }
    facet(index).triangle.corners = {a, b, c};
    facet(index).plane = set_.planeOf(facet(index).triangle);
    return index;
}

void Quickhull::begin(const std::array<int, 4>& corners) {
    const auto [a, b, c, d] = corners;
    made_ = {addFacet(a, b, c), addFacet(a, d, b), addFacet(b, d, c), addFacet(c, d, a)};
    facet(0).triangle.neighbors = {1, 2, 3};
    facet(1).triangle.neighbors = {3, 2, 0};
    facet(2).triangle.neighbors = {1, 3, 0};
    facet(3).triangle.neighbors = {2, 1, 0};
    int others = kNone;
    for (int i = static_cast<int>(next_.size()) - 1; i >= 0; --i) {
        if (std::find(corners.begin(), corners.end(), i) == corners.end()) {
            next_[static_cast<std::size_t>(i)] = others;
            others = i;
        }
    }
    giveTo(others, made_);
}

/// Where the point is to the facet. Where the plane's own rounding is the larger one, as for thin facets, only the
/// exact distance will do.
Side Quickhull::sideOf(const Facet& facet, int point, double& value) const {
    const OrientedPlane& plane = facet.plane;
    const double limit = set_.rounding * plane.length();
    const bool is_good = plane.errorBound() <= limit;
    const double enough = is_good ? 2.0 * limit : limit;
    value = plane.roughly(set_.at(point));
    const bool is_exact =
        std::fabs(value) <= plane.errorBound() || (!is_good && std::fabs(value - enough) <= plane.errorBound());
    if (is_exact) {
        value = plane.exactly(set_.at(point));
    }
    return value > enough ? Side::Outside : value > 0.0 ? Side::Above : Side::Behind;
}

void Quickhull::keep(int index, int point, double value, Side side) {
    Facet& keeper = facet(index);
    int& following = next_[static_cast<std::size_t>(point)];
    if (keeper.first == kNone || value > keeper.furthest) {
        following = keeper.first;
        keeper.first = point;
        keeper.furthest = value;
    } else {
        int& second = next_[static_cast<std::size_t>(keeper.first)];
        following = second;
        second = point;
    }
    keeper.waits = keeper.waits || side == Side::Outside;
}

/// Each point of the list goes to a facet that it is outside of; else to one that it is above, be it by rounding only:
/// facets to come may meet the others at sharp angles, and it would be far outside of those. Else it is inside.
void Quickhull::giveTo(int first_point, const std::vector<int>& facets) {
    for (int point = first_point; point != kNone;) {
        const int following = next_[static_cast<std::size_t>(point)];
        int keeper = kNone;
        double value_there = 0.0;
        Side side_there = Side::Behind;
        for (const int index : facets) {
            double value = 0.0;
            const Side side = sideOf(facet(index), point, value);
            if (side > side_there) {
                keeper = index;
                value_there = value;
                side_there = side;
            }
            if (side == Side::Outside) {
                break;
            }
        }
        if (keeper != kNone) {
            keep(keeper, point, value_there, side_there);
        }
        point = following;
    }
    for (const int index : facets) {
        if (facet(index).waits) {
            waiting_.push_back(index);
        }
    }
}

/// Points that are above their facet by no more than rounding may be outside of others that they see: those get them.
/// False if there are none.
bool Quickhull::giveOn() {
    const std::size_t before = waiting_.size();
    std::vector<int> points;
    std::vector<int> starts;
    for (std::size_t i = 0; i < facets_.size(); ++i) {
        int point = facets_[i].alive ? facets_[i].first : kNone;
        for (; point != kNone; point = next_[static_cast<std::size_t>(point)]) {
            points.push_back(point);
            starts.push_back(static_cast<int>(i));
        }
        facets_[i].first = kNone;
        facets_[i].furthest = 0.0;
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        look(points[i], starts[i]);
        next_[static_cast<std::size_t>(points[i])] = kNone;
        giveTo(points[i], seen_);
    }
    return waiting_.size() > before;
}

/// Finds the facets that the point sees, and their border.
void Quickhull::look(int eye, int start) {
    seen_ = {start};
    horizon_.clear();
    ++looks_;
    facet(start).seen_at = looks_;
    for (std::size_t next = 0; next < seen_.size(); ++next) {
        const int index = seen_[next];
        const Triangle& triangle = facet(index).triangle;
        for (std::size_t edge = 0; edge < 3; ++edge) {
            const int other = triangle.neighbors[edge];
            Facet& neighbor = facet(other);
            if (neighbor.seen_at == looks_) {
                continue;
            }
            if (neighbor.plane.sees(set_.at(eye))) {
                neighbor.seen_at = looks_;
                seen_.push_back(other);
                continue;
            }
            const auto& back = neighbor.triangle.neighbors;
            const auto place = std::find(back.begin(), back.end(), index) - back.begin();
            horizon_.push_back(
                {triangle.corners[edge], triangle.corners[(edge + 1) % 3], other, static_cast<int>(place)});
        }
    }
}

/// The furthest point of the facet becomes a corner: a cone to the border replaces all that it sees.
void Quickhull::addPoint(int start) {
    const int eye = facet(start).first;
    look(eye, start);
    int orphans = kNone;
    for (const int index : seen_) {
        Facet& dead = facet(index);
        dead.alive = false;
        for (int point = dead.first; point != kNone;) {
            const int following = next_[static_cast<std::size_t>(point)];
            if (point != eye) {
                next_[static_cast<std::size_t>(point)] = orphans;
                orphans = point;
            }
            point = following;
        }
        free_.push_back(index);
    }
    made_.clear();
    for (const HorizonEdge& edge : horizon_) {
        const int index = addFacet(edge.from, edge.to, eye);
        facet(index).triangle.neighbors[0] = edge.facet;
        facet(edge.facet).triangle.neighbors[static_cast<std::size_t>(edge.edge)] = index;
        new_at_[static_cast<std::size_t>(edge.from)] = index;
        made_.push_back(index);
    }
    for (const int index : made_) {
        const int following = new_at_[static_cast<std::size_t>(facet(index).triangle.corners[1])];
        facet(index).triangle.neighbors[1] = following;
        facet(following).triangle.neighbors[2] = index;
    }
    giveTo(orphans, made_);
}

std::vector<Triangle> Quickhull::triangles() const {
    std::vector<int> number(facets_.size(), kNone);
    std::vector<Triangle> list;
    for (std::size_t i = 0; i < facets_.size(); ++i) {
        if (facets_[i].alive) {
            number[i] = static_cast<int>(list.size());
            list.push_back(facets_[i].triangle);
        }
    }
    for (Triangle& triangle : list) {
        for (int& neighbor : triangle.neighbors) {
            neighbor = number[static_cast<std::size_t>(neighbor)];
        }
    }
    return list;
}

TriangleHull Quickhull::run() {
    std::array<int, 4> corners{};
    if (const char* spans = findFirst(corners)) {
        return {{}, spans};
    }
    begin(corners);
    // The oldest first, which refines the hull evenly: a cone over what is already fine would have a long border.
    for (std::size_t next = 0; next < waiting_.size() || giveOn(); ++next) {
        const int index = waiting_[next];
        if (facet(index).alive && facet(index).waits) {
            addPoint(index);
        }
    }
    return {triangles(), nullptr};
}

} // namespace

TriangleHull triangleHullOf(const PointSet& set) {
    return Quickhull(set).run();
}

} // namespace elastoon
