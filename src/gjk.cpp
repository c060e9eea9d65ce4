// Based on: Gilbert, Johnson, Keerthi, "A Fast Procedure for Computing the Distance Between Complex Objects in
// Three-Dimensional Space", 1988. The simplex is solved by the faces, edges and vertices that the origin sees.
#include "gjk.h"

#include <algorithm>
#include <cmath>

namespace elastoon {

namespace {

constexpr double kRounding = 0x1p-52;
/// Times the scale: nearer than this is touching.
constexpr double kTouching = 4.0 * kRounding;
constexpr int kMaxSteps = 200;
/// Times the scale: planes short of the distance by less prove it; a distance above has a good enough direction.
constexpr double kShort = 16.0 * kRounding;
constexpr double kVanishing = 1e-6;
/// Squared distances this close, relatively, are the same; so many steps in a row may bring no more than that.
constexpr double kLevel = 8.0 * kRounding;
constexpr int kMaxLevelSteps = 16;
/// Times the scale squared: where the distance times what planes fall short of it is more, that is not rounding.
constexpr double kMisled = 1e-12;

/// A vertex of each body, from its own body's position; their difference is a point of the Minkowski difference.
struct Pair {
    std::uint32_t index_a, index_b;
    Vec3 a, b;
    Vec3 difference; ///< offset + a - b
};

/// The point nearest the origin on a simplex of some of the pairs.
struct Nearest {
    int count = 0;
    std::array<int, 3> pairs{};
    std::array<double, 3> weights{};
    Vec3 point{0.0};
    double squared = 0.0;
    /// Of a triangle: its normal, not unit, and the product of the edges that gave it.
    Vec3 normal{0.0};
    double edge_product = 0.0;
};

class Gjk {
public:
    Gjk(const PosedShape& a, const PosedShape& b) : a_(a), b_(b), offset_(a.position - b.position) {
        scale_ = roundingScale(a, b);
    }

    void seedWith(const ClosestSeed& seed);
    void keepIn(ClosestSeed& seed) const;
    /// Moves a, from where it was posed.
    void moveBy(const Vec3& shift);
    /// False on overlap.
    bool run();

    [[nodiscard]] const Vec3& direction() const { return direction_; }
    [[nodiscard]] double distance() const { return std::sqrt(squared_); }
    [[nodiscard]] double scale() const { return scale_; }
    [[nodiscard]] Closest result(bool apart) const;

    /// Starts where a, far along the line, first lies against b's plane across it. Gives that shift.
    double startAlong(const Vec3& line);
    /// What the simplex is made of, on a and on b.
    [[nodiscard]] std::array<Feature, 2> features() const;
    [[nodiscard]] bool separating() const { return short_by_ <= kShort * scale_ || distance() > kVanishing * scale_; }
    /// What it ended at proves too little for the simplex to be right.
    [[nodiscard]] bool misled() const {
        return short_by_ > kVanishing * scale_ || short_by_ * distance() > kMisled * scale_ * scale_;
    }
    /// Makes the direction one of planes that part the bodies, and gives how far apart those are.
    double partAgain();
    [[nodiscard]] double gapAcross(const Vec3& direction) const {
        return glm::dot(direction, supportAgainst(direction).difference);
    }

private:
    [[nodiscard]] Pair pairOf(std::uint32_t index_a, std::uint32_t index_b) const;
    [[nodiscard]] Pair supportAgainst(const Vec3& direction) const;
    [[nodiscard]] Vec3 edge(int from, int to) const;
    [[nodiscard]] Nearest onVertex(int i) const;
    [[nodiscard]] Nearest onSegment(int i, int j) const;
    [[nodiscard]] Nearest onTriangle(int i, int j, int k) const;
    bool onTetrahedron(Nearest& best);
    bool solve(Nearest& best);
    [[nodiscard]] Vec3 directionTo(const Nearest& nearest) const;
    [[nodiscard]] double boundOf(const Nearest& nearest) const;
    [[nodiscard]] bool better(const Nearest& one, const Nearest& other) const;
    void reduceTo(const Nearest& nearest);
    [[nodiscard]] bool holds(const Pair& pair) const;

    const PosedShape& a_;
    const PosedShape& b_;
    Vec3 offset_;
    double scale_ = 0.0;
    std::array<Pair, 4> pairs_{};
    std::array<double, 4> weights_{};
    int count_ = 0;
    Vec3 direction_{0.0}; ///< unit, from the origin to the simplex
    double squared_ = 0.0;
    double short_by_ = 0.0; ///< by which planes across the direction fail to prove the distance
};

Pair Gjk::pairOf(std::uint32_t index_a, std::uint32_t index_b) const {
    Pair pair{index_a, index_b, a_.linear * a_.shape->vertices()[index_a], b_.linear * b_.shape->vertices()[index_b],
              Vec3(0.0)};
    pair.difference = offset_ + (pair.a - pair.b);
    return pair;
}

/// The pair furthest against the direction.
Pair Gjk::supportAgainst(const Vec3& direction) const {
    const Vec3 in_a = -(direction * a_.linear);
    const Vec3 in_b = direction * b_.linear;
    if (count_ == 0) {
        return pairOf(static_cast<std::uint32_t>(a_.shape->supportVertex(in_a)),
                      static_cast<std::uint32_t>(b_.shape->supportVertex(in_b)));
    }
    return pairOf(climb(a_.shape->vertices(), a_.shape->topology(), in_a, pairs_[0].index_a),
                  climb(b_.shape->vertices(), b_.shape->topology(), in_b, pairs_[0].index_b));
}

/// Exact where the two share a vertex, and relative to the smaller body where they do not differ in the larger.
Vec3 Gjk::edge(int from, int to) const {
    const Pair& p = pairs_[static_cast<std::size_t>(from)];
    const Pair& q = pairs_[static_cast<std::size_t>(to)];
    return (q.a - p.a) - (q.b - p.b);
}

Nearest Gjk::onVertex(int i) const {
    Nearest nearest;
    nearest.count = 1;
    nearest.pairs[0] = i;
    nearest.weights[0] = 1.0;
    nearest.point = pairs_[static_cast<std::size_t>(i)].difference;
    nearest.squared = glm::dot(nearest.point, nearest.point);
    return nearest;
}

Nearest Gjk::onSegment(int i, int j) const {
    const Vec3 along = edge(i, j);
    const double squared = glm::dot(along, along);
    const double reach = -glm::dot(along, pairs_[static_cast<std::size_t>(i)].difference);
    if (!(reach > 0.0)) {
        return onVertex(i);
    }
    const double left = glm::dot(along, pairs_[static_cast<std::size_t>(j)].difference);
    if (!(left > 0.0)) {
        return onVertex(j);
    }
    Nearest nearest;
    nearest.count = 2;
    nearest.pairs = {i, j, 0};
    const double weight = std::min(reach / squared, 1.0);
    nearest.weights = {1.0 - weight, weight, 0.0};
    nearest.point = reach < left ? pairs_[static_cast<std::size_t>(i)].difference + weight * along
                                 : pairs_[static_cast<std::size_t>(j)].difference - (left / squared) * along;
    nearest.squared = glm::dot(nearest.point, nearest.point);
    return nearest;
}

Nearest Gjk::onTriangle(int i, int j, int k) const {
    const std::array<int, 3> corner{i, j, k};
    std::array<Vec3, 3> side; // opposite the corner
    std::array<double, 3> squared{};
    for (std::size_t c = 0; c < 3; ++c) {
        side[c] = edge(corner[(c + 1) % 3], corner[(c + 2) % 3]);
        squared[c] = glm::dot(side[c], side[c]);
    }
    // The two shorter sides give the truest normal.
    const std::size_t longest = squared[0] >= squared[1] && squared[0] >= squared[2] ? 0
                                : squared[1] >= squared[2]                           ? 1
                                                                                     : 2;
    Vec3 normal = glm::cross(side[(longest + 1) % 3], side[(longest + 2) % 3]);
    // Of a thin triangle, the rounding that tilts it along its length does the harm.
    normal -= side[longest] * (glm::dot(normal, side[longest]) / squared[longest]);
    const double area = glm::dot(normal, normal);
    Nearest nearest;
    nearest.normal = normal;
    nearest.edge_product = std::sqrt(squared[(longest + 1) % 3] * squared[(longest + 2) % 3]);
    std::array<double, 3> weight{};
    std::array<bool, 3> sees{};
    std::array<Vec3, 3> inward;
    bool within = area > 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
        inward[c] = glm::cross(normal, side[c]);
        weight[c] = -glm::dot(inward[c], pairs_[static_cast<std::size_t>(corner[(c + 1) % 3])].difference);
        sees[c] = !(weight[c] > 0.0);
        within = within && !sees[c];
    }
    if (!within) {
        bool any = false;
        for (std::size_t c = 0; c < 3; ++c) {
            if (sees[c] || !(area > 0.0)) {
                const Nearest other = onSegment(corner[(c + 1) % 3], corner[(c + 2) % 3]);
                if (!any || other.squared < nearest.squared) {
                    nearest = other;
                    any = true;
                }
            }
        }
        return nearest;
    }
    const auto place = [&] {
        const double sum = weight[0] + weight[1] + weight[2];
        for (double& w : weight) {
            w /= sum;
        }
        // From the heaviest corner: the nearest to the point.
        const std::size_t base = weight[0] >= weight[1] && weight[0] >= weight[2] ? 0 : weight[1] >= weight[2] ? 1 : 2;
        nearest.point = pairs_[static_cast<std::size_t>(corner[base])].difference +
                        weight[(base + 1) % 3] * side[(base + 2) % 3] - weight[(base + 2) % 3] * side[(base + 1) % 3];
    };
    place();
    // Once more from the point found: its own foot is at the point, but for the rounding of the first time.
    for (std::size_t c = 0; c < 3; ++c) {
        weight[c] = std::max(0.0, weight[c] - glm::dot(inward[c], nearest.point) / area);
    }
    place();
    nearest.count = 3;
    nearest.pairs = corner;
    nearest.weights = weight;
    nearest.squared = glm::dot(nearest.point, nearest.point);
    return nearest;
}

/// Nearer; or, where that is below rounding, with the better plane: a distance answers a turn of the plane only by the
/// turn's square, so that faces a billionth of a radian apart look equally near.
bool Gjk::better(const Nearest& one, const Nearest& other) const {
    if (std::fabs(one.squared - other.squared) > kLevel * other.squared) {
        return one.squared < other.squared;
    }
    return boundOf(one) > boundOf(other);
}

/// True if the origin is inside; the weights are then set.
bool Gjk::onTetrahedron(Nearest& best) {
    constexpr std::array<std::array<int, 4>, 4> kFaces{{{1, 2, 3, 0}, {0, 2, 3, 1}, {0, 1, 3, 2}, {0, 1, 2, 3}}};
    std::array<Vec3, 4> rise; // of the weight, towards the corner opposite the face
    std::array<double, 4> weight{};
    bool any = false;
    const auto lookAt = [&](const std::array<int, 4>& face) {
        const Nearest other = onTriangle(face[0], face[1], face[2]);
        if (!any || better(other, best)) {
            best = other;
        }
        any = true;
    };
    for (std::size_t f = 0; f < 4; ++f) {
        const auto [i, j, k, opposite] = kFaces[f];
        const Vec3 normal = glm::cross(edge(i, j), edge(i, k));
        const double thickness = glm::dot(normal, edge(i, opposite));
        const double depth = -glm::dot(normal, pairs_[static_cast<std::size_t>(i)].difference);
        const double noise = kTouching * scale_ * glm::length(normal);
        const bool flat = !(std::fabs(thickness) > noise);
        if (flat || !(thickness > 0.0 ? depth > 0.0 : depth < 0.0)) {
            lookAt(kFaces[f]);
        } else {
            weight[f] = depth / thickness;
            rise[f] = normal / thickness;
        }
    }
    if (any) {
        return false;
    }
    const auto rest = [&] {
        weights_ = weight;
        Vec3 sum(0.0);
        double total = 0.0;
        for (std::size_t f = 0; f < 4; ++f) {
            total += weight[f];
            sum += weight[f] * pairs_[f].difference;
        }
        for (double& w : weights_) {
            w /= total;
        }
        return sum / total;
    };
    Vec3 off = rest();
    if (glm::length(off) > kTouching * scale_) {
        for (std::size_t f = 0; f < 4; ++f) {
            weight[f] = std::max(0.0, weights_[f] - glm::dot(rise[f], off));
        }
        off = rest();
    }
    if (glm::length(off) <= kTouching * scale_) {
        return true;
    }
    // Thin: a point of it is as near as that, and the origin is inside if every face is further.
    std::for_each(kFaces.begin(), kFaces.end(), lookAt);
    return best.squared > glm::dot(off, off);
}

/// True if the origin is inside.
bool Gjk::solve(Nearest& best) {
    switch (count_) {
    case 1:
        best = onVertex(0);
        return false;
    case 2:
        best = onSegment(0, 1);
        return false;
    case 3:
        best = onTriangle(0, 1, 2);
        return false;
    default:
        return onTetrahedron(best);
    }
}

/// Unit, from the origin to the point. A triangle's own normal is truer than the point, unless the triangle is thinner
/// than the distance is short.
Vec3 Gjk::directionTo(const Nearest& nearest) const {
    const double length = std::sqrt(nearest.squared);
    if (nearest.count == 3) {
        const double area = glm::length(nearest.normal);
        if (nearest.edge_product * length <= area * scale_) {
            return nearest.normal * ((glm::dot(nearest.normal, nearest.point) < 0.0 ? -1.0 : 1.0) / area);
        }
    }
    return length > 0.0 ? nearest.point / length : Vec3(0.0);
}

/// How far the plane across the direction keeps the whole tetrahedron from the origin.
double Gjk::boundOf(const Nearest& nearest) const {
    const Vec3 direction = directionTo(nearest);
    double least = glm::dot(direction, pairs_[0].difference);
    for (std::size_t i = 1; i < 4; ++i) {
        least = std::min(least, glm::dot(direction, pairs_[i].difference));
    }
    return least;
}

void Gjk::reduceTo(const Nearest& nearest) {
    const std::array<Pair, 4> old = pairs_;
    for (std::size_t i = 0; i < static_cast<std::size_t>(nearest.count); ++i) {
        pairs_[i] = old[static_cast<std::size_t>(nearest.pairs[i])];
        weights_[i] = nearest.weights[i];
    }
    count_ = nearest.count;
    squared_ = nearest.squared;
    direction_ = directionTo(nearest);
}

bool Gjk::holds(const Pair& pair) const {
    return std::any_of(pairs_.begin(), pairs_.begin() + count_,
                       [&](const Pair& p) { return p.index_a == pair.index_a && p.index_b == pair.index_b; });
}

void Gjk::seedWith(const ClosestSeed& seed) {
    count_ = 0;
    for (std::size_t i = 0; i < seed.pair_count; ++i) {
        pairs_[i] = pairOf(seed.pairs_a[i], seed.pairs_b[i]);
        ++count_;
    }
}

void Gjk::keepIn(ClosestSeed& seed) const {
    seed.pair_count = static_cast<std::uint8_t>(count_);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i) {
        seed.pairs_a[i] = pairs_[i].index_a;
        seed.pairs_b[i] = pairs_[i].index_b;
    }
}

void Gjk::moveBy(const Vec3& shift) {
    offset_ = (a_.position - b_.position) + shift;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i) {
        pairs_[i].difference = offset_ + (pairs_[i].a - pairs_[i].b);
    }
}

bool Gjk::run() {
    if (count_ == 0) {
        pairs_[0] = supportAgainst(offset_);
        count_ = 1;
    }
    const double touching = kTouching * scale_;
    Nearest nearest;
    if (solve(nearest)) {
        return false;
    }
    reduceTo(nearest);
    double least = squared_;
    for (int step = 0, level_steps = 0; step < kMaxSteps; ++step) {
        if (squared_ <= touching * touching) {
            return false;
        }
        const Pair next = supportAgainst(direction_);
        // How much nearer the furthest plane across the direction is than the simplex.
        short_by_ = 0.0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i) {
            short_by_ = std::max(short_by_, glm::dot(direction_, (pairs_[i].a - next.a) - (pairs_[i].b - next.b)));
        }
        if (holds(next) || short_by_ <= 2.0 * kRounding * scale_) {
            return true;
        }
        pairs_[static_cast<std::size_t>(count_++)] = next;
        if (solve(nearest)) {
            return false;
        }
        level_steps = nearest.squared < least ? 0 : level_steps + 1;
        // A distance has the rounding of the points, which its square has magnified where it is short.
        if (!(nearest.squared <= least * (1.0 + kLevel) + touching * std::sqrt(least)) ||
            level_steps > kMaxLevelSteps) {
            --count_;
            return true;
        }
        reduceTo(nearest);
        least = std::min(least, squared_);
    }
    return true;
}

/// Up to four vertices of one body, each once.
struct Vertices {
    std::array<std::uint32_t, 4> index{};
    std::size_t count = 0;

    void add(std::uint32_t vertex) {
        for (std::size_t i = 0; i < count; ++i) {
            if (index[i] == vertex) {
                return;
            }
        }
        index[count++] = vertex;
    }
    [[nodiscard]] std::size_t heldBy(std::span<const std::uint32_t> loop) const {
        std::size_t held = 0;
        for (std::size_t i = 0; i < count; ++i) {
            held += std::find(loop.begin(), loop.end(), index[i]) != loop.end() ? 1 : 0;
        }
        return held;
    }
};

/// The feature of least dimension that holds the vertices.
Feature featureOf(const Shape& shape, const Vertices& vertices) {
    const std::uint32_t first = vertices.index[0];
    if (vertices.count == 1) {
        return {Feature::Kind::Vertex, first};
    }
    const Topology& topology = shape.topology();
    const auto neighbors = topology.neighborsOf(first);
    const auto edges = topology.edgesOfVertex(first);
    if (vertices.count == 2) {
        for (std::size_t i = 0; i < edges.size(); ++i) {
            if (neighbors[i] == vertices.index[1]) {
                return {Feature::Kind::Edge, edges[i]};
            }
        }
    }
    // Rounding can put vertices together that no face holds: then the face that holds most.
    Feature best{Feature::Kind::Vertex, first};
    std::size_t most = 1;
    for (const std::uint32_t edge : edges) {
        for (const std::uint32_t face : {topology.edges[edge].left, topology.edges[edge].right}) {
            const std::size_t held = face == Topology::kNone ? 0 : vertices.heldBy(shape.face(face));
            if (held > most) {
                most = held;
                best = {Feature::Kind::Face, face};
            }
        }
    }
    return best;
}

std::array<Feature, 2> Gjk::features() const {
    Vertices of_a;
    Vertices of_b;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i) {
        of_a.add(pairs_[i].index_a);
        of_b.add(pairs_[i].index_b);
    }
    return {featureOf(*a_.shape, of_a), featureOf(*b_.shape, of_b)};
}

Closest Gjk::result(bool apart) const {
    Closest closest;
    Vec3 a(0.0);
    Vec3 b(0.0);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i) {
        a += weights_[i] * pairs_[i].a;
        b += weights_[i] * pairs_[i].b;
    }
    closest.point_a = a_.position + a;
    closest.point_b = b_.position + b;
    closest.overlap = !apart;
    if (!apart) {
        closest.witness = 0.5 * (closest.point_a + closest.point_b);
        return closest;
    }
    const auto [feature_a, feature_b] = features();
    closest.feature_a = feature_a;
    closest.feature_b = feature_b;
    closest.distance = std::sqrt(squared_);
    closest.normal = separating() ? direction_ : partingNormal(a_, b_, direction_);
    return closest;
}

/// Steers by the features where the distance is too small to give a direction that planes prove.
double Gjk::partAgain() {
    if (separating()) {
        return distance();
    }
    PosedShape moved = a_;
    moved.position = b_.position + offset_;
    direction_ = partingNormal(moved, b_, direction_);
    return std::min(distance(), gapAcross(direction_));
}

double Gjk::startAlong(const Vec3& line) {
    pairs_[0] = supportAgainst(line);
    count_ = 1;
    return -glm::dot(line, offset_) - glm::dot(line, pairs_[0].a - pairs_[0].b);
}

} // namespace

Closest gjkClosest(const PosedShape& a, const PosedShape& b, ClosestSeed& seed) {
    Gjk gjk(a, b);
    gjk.seedWith(seed);
    bool apart = gjk.run();
    if (apart && seed.pair_count > 0 && gjk.misled()) {
        // Flat to within rounding in this pose, a simplex has a normal and weights of noise.
        gjk.seedWith({});
        apart = gjk.run();
    }
    gjk.keepIn(seed);
    return gjk.result(apart);
}

// Near a touching place the bodies are cones, and the normal there is the part of the way apart that lies in the cone
// of normals. Apart along the centers always works: the planes that part two bodies part their centers.
Vec3 partingNormal(const PosedShape& a, const PosedShape& b, const Vec3& normal) {
    Gjk gjk(a, b);
    Vec3 best = normal;
    double widest = gjk.gapAcross(normal);
    const Vec3 centers = a.position - b.position;
    for (const Vec3& way : {normal, centers / glm::length(centers)}) {
        for (const double distance : {1e-3, 1e-5}) {
            gjk.moveBy(distance * gjk.scale() * way);
            if (!gjk.run()) {
                continue;
            }
            const Vec3 direction = gjk.direction();
            gjk.moveBy(Vec3(0.0));
            const double gap = gjk.gapAcross(direction);
            if (gap > widest) {
                widest = gap;
                best = direction;
            }
        }
    }
    return best;
}

// Newton's method on the distance, a convex function of the shift: from outside it never passes the contact, and where
// the bodies touch the distance is a cone, so that the last step is exact.
std::optional<LineContact> contactAlongByDistance(const PosedShape& a, const PosedShape& b, const Vec3& direction) {
    Gjk gjk(a, b);
    LineContact contact;
    contact.shift = gjk.startAlong(direction);
    contact.normal = direction;
    const double touching = kTouching * gjk.scale();
    for (int step = 0; step < kMaxSteps; ++step) {
        gjk.moveBy(contact.shift * direction);
        if (!gjk.run()) {
            break;
        }
        const double gap = gjk.partAgain();
        if (!(gap > touching)) {
            break;
        }
        const double slope = glm::dot(gjk.direction(), direction);
        if (!(slope > 0.0)) {
            return std::nullopt;
        }
        contact.normal = gjk.direction();
        contact.shift -= gap / slope;
    }
    return contact;
}

} // namespace elastoon
