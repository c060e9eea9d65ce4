// Based on: Mirtich, "V-Clip: Fast and Robust Polyhedral Collision Detection", ACM Transactions on Graphics 17(3),
// 1998. It deviates where docs/vclip.md says: planes from the posed vertices, slopes from products, proof at the end.
#include "vclip.h"

#include "gjk.h"
#include "vclip_body.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace elastoon {

namespace {

using Kind = Feature::Kind;
constexpr double kRounding = 0x1p-52;
/// An end that parallel planes prove to this much of the size is right.
constexpr double kProven = 1e-12;
/// Times the size: below this distance the direction between the points is tried by planes, and must be this good.
constexpr double kVanishing = 1e-6;
constexpr double kShort = 16.0 * kRounding;

using Body = VclipBody;
using Clip = VclipSegment;

/// Where the distance from the segment to a feature grows along the segment: its sign. Touching where it is at 0.
struct Slope {
    double sign = 0.0;
    bool touches = false;
};

class Vclip {
public:
    Vclip(const PosedShape& a, const PosedShape& b) : a_(a, a.position - b.position), b_(b, Vec3(0.0)) {}

    enum class Step { On, Done, Inside };
    /// Replaces a feature by a neighbour, or stops.
    Step step(Feature& a, Feature& b);

    [[nodiscard]] Closest overlapResult() const;
    [[nodiscard]] Closest apartResult(const Feature& a, const Feature& b) const;
    [[nodiscard]] const Body& a() const { return a_; }
    [[nodiscard]] const Body& b() const { return b_; }
    [[nodiscard]] int escapes() const { return escapes_; }

private:
    bool leavesVertex(const Body& body, Feature& vertex, const Vec3& point) const;
    Step vertexVertex(Feature& a, Feature& b);
    Step vertexEdge(const Body& p, Feature& vertex, const Body& q, Feature& edge);
    Step vertexFace(const Body& p, Feature& vertex, const Body& q, Feature& face);
    Step escape(const Vec3& point, const Body& q, Feature& face);
    Step edgeEdge(const Body& p, const Feature& first, const Body& q, Feature& second);
    Step edgeFace(const Body& p, Feature& edge, const Body& q, Feature& face);
    Slope slopeTo(const Clip& clip, double l, const Body& q, const Feature& neighbor);
    Step leaveByEnd(const Clip& clip, const Body& q, Feature& second);
    static Feature borderNearest(const Clip& segment, const Body& q, std::uint32_t face);

    Body a_, b_;
    Vec3 witness_{0.0};
    int escapes_ = 0;
};

Slope Vclip::slopeTo(const Clip& clip, double l, const Body& q, const Feature& neighbor) {
    const Vec3 point = clip.at(l);
    if (neighbor.kind == Kind::Vertex) {
        const Vec3 from = point - q.at(neighbor.index);
        witness_ = point;
        return {glm::dot(clip.along, from), from == Vec3(0.0)};
    }
    const Vec3 normal = q.normal(neighbor.index);
    const double height = q.height(neighbor.index, normal, point);
    const double rise = glm::dot(normal, clip.along);
    witness_ = point;
    return {height > 0.0 ? rise : -rise, height == 0.0};
}

/// To the neighbour beyond an end of what is left of the segment, if the distance falls that way. To a vertex the
/// distance is the same from all its region; else it is taken to the neighbour. Done: it falls nowhere.
Vclip::Step Vclip::leaveByEnd(const Clip& clip, const Body& q, Feature& second) {
    const bool of_vertex = second.kind == Kind::Vertex;
    if (clip.has_low) {
        const Slope slope = slopeTo(clip, clip.low, q, of_vertex ? second : clip.low_neighbor);
        if (slope.touches) {
            return Step::Inside;
        }
        if (slope.sign > 0.0) {
            second = clip.low_neighbor;
            return Step::On;
        }
    }
    if (clip.has_high) {
        const Slope slope = slopeTo(clip, clip.high, q, of_vertex ? second : clip.high_neighbor);
        if (slope.touches) {
            return Step::Inside;
        }
        if (slope.sign < 0.0) {
            second = clip.high_neighbor;
            return Step::On;
        }
    }
    return Step::Done;
}

/// Whether the point lies beyond the plane of some edge of the vertex; it is then the edge's.
bool Vclip::leavesVertex(const Body& body, Feature& vertex, const Vec3& point) const {
    const Vec3 from = point - body.at(vertex.index);
    for (const std::uint32_t edge : body.topology.edgesOfVertex(vertex.index)) {
        if (glm::dot(body.awayFrom(vertex.index, edge), from) > 0.0) {
            vertex = {Kind::Edge, edge};
            return true;
        }
    }
    return false;
}

Vclip::Step Vclip::vertexVertex(Feature& a, Feature& b) {
    if (leavesVertex(a_, a, b_.at(b.index)) || leavesVertex(b_, b, a_.at(a.index))) {
        return Step::On;
    }
    return Step::Done;
}

Vclip::Step Vclip::vertexEdge(const Body& p, Feature& vertex, const Body& q, Feature& edge) {
    const Vec3 point = p.at(vertex.index);
    const Topology::Edge& ends = q.ends(edge.index);
    Clip clip(q, edge.index);
    if (glm::dot(clip.along, point - clip.tail) < 0.0) {
        edge = {Kind::Vertex, ends.tail};
        return Step::On;
    }
    if (glm::dot(clip.along, point - clip.head) > 0.0) {
        edge = {Kind::Vertex, ends.head};
        return Step::On;
    }
    for (const std::uint32_t face : {ends.left, ends.right}) {
        if (glm::dot(q.outOf(face, edge.index), point - clip.tail) < 0.0) {
            edge = {Kind::Face, face};
            return Step::On;
        }
    }
    for (const std::uint32_t neighbor : p.topology.edgesOfVertex(vertex.index)) {
        if (!clip.by(-p.awayFrom(vertex.index, neighbor), point, {Kind::Edge, neighbor})) {
            vertex = {Kind::Edge, neighbor};
            return Step::On;
        }
    }
    return leaveByEnd(clip, p, vertex);
}

Vclip::Step Vclip::vertexFace(const Body& p, Feature& vertex, const Body& q, Feature& face) {
    const Vec3 point = p.at(vertex.index);
    // By true distance: a step to another violated plane could lead further away.
    double worst = 0.0;
    std::uint32_t worst_edge = Topology::kNone;
    const Vec3 normal = q.normal(face.index);
    for (const std::uint32_t edge : q.topology.edgesOfFace(face.index)) {
        const Vec3 out = q.outOf(face.index, edge);
        const double beyond = glm::dot(out, point - q.at(q.ends(edge).tail));
        if (beyond > 0.0) {
            const double squared = beyond * beyond / glm::dot(out, out);
            if (squared > worst || worst_edge == Topology::kNone) {
                worst = squared;
                worst_edge = edge;
            }
        }
    }
    if (worst_edge != Topology::kNone) {
        face = {Kind::Edge, worst_edge};
        return Step::On;
    }
    const double height = q.height(face.index, normal, point);
    if (height == 0.0) {
        witness_ = point;
        return Step::Inside;
    }
    for (const std::uint32_t edge : p.topology.edgesOfVertex(vertex.index)) {
        const double rise = glm::dot(normal, p.awayFrom(vertex.index, edge));
        if (height > 0.0 ? rise < 0.0 : rise > 0.0) {
            vertex = {Kind::Edge, edge};
            return Step::On;
        }
    }
    return height > 0.0 ? Step::Done : escape(point, q, face);
}

/// The vertex is nearest of its body to a plane that it is behind: it is inside, or another face is the one to look at.
Vclip::Step Vclip::escape(const Vec3& point, const Body& q, Feature& face) {
    ++escapes_;
    double most = 0.0;
    std::uint32_t best = Topology::kNone;
    for (std::uint32_t f = 0; f < q.topology.face_normals.size(); ++f) {
        const Vec3 normal = q.normal(f);
        const double height = q.height(f, normal, point);
        if (height > 0.0) {
            const double squared = height * height / glm::dot(normal, normal);
            if (squared > most || best == Topology::kNone) {
                most = squared;
                best = f;
            }
        }
    }
    if (best == Topology::kNone) {
        witness_ = point;
        return Step::Inside;
    }
    face.index = best;
    return Step::On;
}

/// Half of the edge-edge state: the first edge clipped to the region of the second. Done: nothing to say.
Vclip::Step Vclip::edgeEdge(const Body& p, const Feature& first, const Body& q, Feature& second) {
    const std::uint32_t edge = second.index;
    const Topology::Edge& ends = q.ends(edge);
    const Vec3 along = q.along(edge);
    const Vec3 base = q.at(ends.tail);
    const Feature tail{Kind::Vertex, ends.tail};
    const Feature head{Kind::Vertex, ends.head};
    const auto goTo = [&](const Feature& neighbor) {
        second = neighbor;
        return Step::On;
    };
    Clip clip(p, first.index);
    if (!clip.by(along, base, tail)) {
        return goTo(tail);
    }
    if (!clip.by(-along, q.at(ends.head), head)) {
        return goTo(head);
    }
    const Clip between = clip;
    for (const std::uint32_t face : {ends.left, ends.right}) {
        if (!clip.by(q.outOf(face, edge), base, {Kind::Face, face})) {
            // The ends first: the face's plane goes on below the face, where the way is to a vertex.
            const Step step = leaveByEnd(between, q, second);
            return step == Step::Done ? goTo({Kind::Face, face}) : step;
        }
    }
    if (!clip.empty()) {
        return leaveByEnd(clip, q, second);
    }
    const bool by_high = clip.low_neighbor.kind != Kind::Vertex && clip.high_neighbor.kind == Kind::Vertex;
    const Slope slope =
        by_high ? slopeTo(clip, clip.high, q, clip.high_neighbor) : slopeTo(clip, clip.low, q, clip.low_neighbor);
    if (slope.touches) {
        return Step::Inside;
    }
    const bool to_low = by_high ? !(slope.sign < 0.0) : slope.sign > 0.0;
    return goTo(to_low ? clip.low_neighbor : clip.high_neighbor);
}

/// Edge or corner of the face that is nearest the segment.
Feature Vclip::borderNearest(const Clip& segment, const Body& q, std::uint32_t face) {
    Feature best;
    double least = 0.0;
    bool any = false;
    for (const std::uint32_t edge : q.topology.edgesOfFace(face)) {
        const Topology::Edge& ends = q.ends(edge);
        const SegmentPair pair = nearestOfSegments(segment.tail, segment.along, q.at(ends.tail), q.along(edge));
        const double squared = glm::dot(pair.difference, pair.difference);
        if (!any || squared < least) {
            any = true;
            least = squared;
            best = pair.t <= 0.0   ? Feature{Kind::Vertex, ends.tail}
                   : pair.t >= 1.0 ? Feature{Kind::Vertex, ends.head}
                                   : Feature{Kind::Edge, edge};
        }
    }
    return best;
}

Vclip::Step Vclip::edgeFace(const Body& p, Feature& edge, const Body& q, Feature& face) {
    Clip clip(p, edge.index);
    bool excluded = false;
    for (const std::uint32_t side : q.topology.edgesOfFace(face.index)) {
        if (!clip.by(-q.outOf(face.index, side), q.at(q.ends(side).tail), {Kind::Edge, side})) {
            excluded = true;
            break;
        }
    }
    if (excluded || clip.empty()) {
        face = borderNearest(clip, q, face.index);
        return Step::On;
    }
    const Vec3 normal = q.normal(face.index);
    const double at_low = q.height(face.index, normal, clip.at(clip.low));
    const double at_high = q.height(face.index, normal, clip.at(clip.high));
    if (!(at_low > 0.0 && at_high > 0.0) && !(at_low < 0.0 && at_high < 0.0)) {
        const double part = at_low != at_high ? at_low / (at_low - at_high) : 0.0;
        witness_ = clip.at(clip.low + part * (clip.high - clip.low));
        return Step::Inside;
    }
    const double rise = glm::dot(normal, clip.along);
    if (at_low > 0.0 ? rise >= 0.0 : rise <= 0.0) {
        (clip.has_low ? face : edge) =
            clip.has_low ? clip.low_neighbor : Feature{Kind::Vertex, p.ends(edge.index).tail};
    } else {
        (clip.has_high ? face : edge) =
            clip.has_high ? clip.high_neighbor : Feature{Kind::Vertex, p.ends(edge.index).head};
    }
    return Step::On;
}

Vclip::Step Vclip::step(Feature& a, Feature& b) {
    if (a.kind == Kind::Vertex) {
        return b.kind == Kind::Vertex ? vertexVertex(a, b)
               : b.kind == Kind::Edge ? vertexEdge(a_, a, b_, b)
                                      : vertexFace(a_, a, b_, b);
    }
    if (b.kind == Kind::Vertex) {
        return a.kind == Kind::Edge ? vertexEdge(b_, b, a_, a) : vertexFace(b_, b, a_, a);
    }
    if (a.kind == Kind::Edge && b.kind == Kind::Edge) {
        const Step first = edgeEdge(a_, a, b_, b);
        return first == Step::Done ? edgeEdge(b_, b, a_, a) : first;
    }
    return a.kind == Kind::Edge ? edgeFace(a_, a, b_, b) : edgeFace(b_, b, a_, a);
}

Closest Vclip::overlapResult() const {
    Closest closest;
    closest.overlap = true;
    closest.witness = b_.posed.position + witness_;
    closest.point_a = closest.point_b = closest.witness;
    return closest;
}

/// The points of the two features, and the direction between them.
struct Ends {
    Vec3 a{0.0}, b{0.0};
    Vec3 normal{0.0}; ///< of the features; not unit
    double trust = 0.0; ///< rounding of the normal, relative; 0: there is none
};

Ends endsOf(const Body& p, const Feature& first, const Body& q, const Feature& second) {
    Ends ends;
    if (first.kind == Kind::Vertex) {
        ends.a = p.at(first.index);
        if (second.kind == Kind::Vertex) {
            ends.b = q.at(second.index);
        } else if (second.kind == Kind::Edge) {
            const Vec3 tail = q.at(q.ends(second.index).tail);
            const Vec3 along = q.along(second.index);
            ends.b = tail + std::clamp(glm::dot(along, ends.a - tail) / glm::dot(along, along), 0.0, 1.0) * along;
        } else {
            ends.normal = q.normal(second.index);
            ends.trust = 1.0;
            const double height = q.height(second.index, ends.normal, ends.a);
            ends.b = ends.a - (height / glm::dot(ends.normal, ends.normal)) * ends.normal;
        }
        return ends;
    }
    const Vec3 tail_p = p.at(p.ends(first.index).tail);
    const Vec3 tail_q = q.at(q.ends(second.index).tail);
    const Vec3 u = p.along(first.index);
    const Vec3 v = q.along(second.index);
    const SegmentPair pair = nearestOfSegments(tail_p, u, tail_q, v);
    ends.a = tail_p + pair.s * u;
    ends.b = tail_q + pair.t * v;
    if (pair.s > 0.0 && pair.s < 1.0 && pair.t > 0.0 && pair.t < 1.0) {
        ends.normal = pair.across;
        ends.trust = glm::length(pair.across) / std::sqrt(glm::dot(u, u) * glm::dot(v, v));
    }
    return ends;
}

Closest Vclip::apartResult(const Feature& a, const Feature& b) const {
    const bool swapped = b.kind == Kind::Vertex && a.kind != Kind::Vertex;
    Ends ends = swapped ? endsOf(b_, b, a_, a) : endsOf(a_, a, b_, b);
    if (swapped) {
        std::swap(ends.a, ends.b);
    }
    const double scale = roundingScale(a_.posed, b_.posed);
    Closest closest;
    closest.feature_a = a;
    closest.feature_b = b;
    const Vec3 difference = ends.a - ends.b;
    closest.distance = glm::length(difference);
    closest.point_a = b_.posed.position + ends.a;
    closest.point_b = b_.posed.position + ends.b;
    if (closest.distance <= 4.0 * kRounding * scale) {
        closest.distance = 0.0;
        closest.overlap = true;
        closest.witness = 0.5 * (closest.point_a + closest.point_b);
        return closest;
    }
    closest.normal = difference / closest.distance;
    if (closest.distance < ends.trust * scale) {
        const double length = glm::length(ends.normal);
        closest.normal = ends.normal * ((glm::dot(ends.normal, difference) < 0.0 ? -1.0 : 1.0) / length);
    }
    return closest;
}

/// Gap between planes across the normal, at the bodies' furthest vertices.
double gapAcross(const Vclip& walk, const Closest& closest) {
    const auto nearVertex = [](const Body& body, const Feature& feature) {
        return feature.kind == Kind::Vertex ? feature.index
               : feature.kind == Kind::Edge ? body.ends(feature.index).tail
                                            : body.posed.shape->face(feature.index)[0];
    };
    const Body& a = walk.a();
    const Body& b = walk.b();
    const std::uint32_t low =
        climb(a.vertices, a.topology, -(closest.normal * a.posed.linear), nearVertex(a, closest.feature_a));
    const std::uint32_t high =
        climb(b.vertices, b.topology, closest.normal * b.posed.linear, nearVertex(b, closest.feature_b));
    return glm::dot(closest.normal, a.at(low) - b.at(high));
}

/// Whether planes across the normal are as far apart as the points. Where the points are too close to give a normal it
/// is first made from the features.
bool prove(const Vclip& walk, Closest& closest) {
    const double scale = roundingScale(walk.a().posed, walk.b().posed);
    double gap = gapAcross(walk, closest);
    if (closest.distance < kVanishing * scale && !(closest.distance - gap <= kShort * scale)) {
        closest.normal = partingNormal(walk.a().posed, walk.b().posed, closest.normal);
        gap = gapAcross(walk, closest);
    }
    return std::fabs(closest.distance - gap) <= kProven * scale;
}

std::uint32_t supportOf(const Body& body, const Vec3& direction) {
    return static_cast<std::uint32_t>(body.posed.shape->supportVertex(direction * body.posed.linear));
}

/// The face of the shape that the point (shape frame) is highest over; of many faces, of those at the corner towards
/// it.
std::uint32_t faceUnder(const Shape& shape, const Vec3& point) {
    constexpr std::size_t kFewFaces = 16;
    const Topology& topology = shape.topology();
    std::uint32_t best = 0;
    double highest = -std::numeric_limits<double>::infinity();
    const auto consider = [&](std::uint32_t face) {
        const double height = glm::dot(topology.face_normals[face], point - shape.vertices()[shape.face(face)[0]]);
        if (height > highest) {
            highest = height;
            best = face;
        }
    };
    if (const std::size_t count = topology.face_normals.size(); count <= kFewFaces) {
        for (std::uint32_t face = 0; face < count; ++face) {
            consider(face);
        }
        return best;
    }
    const auto corner = static_cast<std::uint32_t>(shape.supportVertex(point));
    for (const std::uint32_t edge : topology.edgesOfVertex(corner)) {
        consider(topology.edges[edge].tail == corner ? topology.edges[edge].left : topology.edges[edge].right);
    }
    return best;
}

/// The feature nearest to the point, to a guess that is made in the body's own frame: it may be stretched. `nearest` is
/// about its point.
Feature featureUnder(const Body& q, const Vec3& point, Vec3& nearest) {
    const double volume = glm::dot(q.posed.linear[0], q.cofactor[0]);
    const Vec3 own = ((point - q.offset) * q.cofactor) / volume;
    const std::uint32_t face = faceUnder(*q.posed.shape, own);
    const Vec3& normal = q.topology.face_normals[face];
    std::uint32_t side = Topology::kNone;
    double furthest = 0.0;
    for (const std::uint32_t edge : q.topology.edgesOfFace(face)) {
        const Topology::Edge& ends = q.ends(edge);
        const Vec3 out =
            glm::cross(q.vertices[ends.head] - q.vertices[ends.tail], ends.left == face ? normal : -normal);
        const double beyond = glm::dot(out, own - q.vertices[ends.tail]);
        const double squared = glm::dot(out, out);
        if (beyond > 0.0 && beyond * beyond > furthest * squared) {
            furthest = beyond * beyond / squared;
            side = edge;
        }
    }
    const Vec3& tail = q.vertices[side == Topology::kNone ? q.posed.shape->face(face)[0] : q.ends(side).tail];
    if (side == Topology::kNone) {
        nearest = q.offset + q.posed.linear * (own - normal * glm::dot(normal, own - tail));
        return {Kind::Face, face};
    }
    const Vec3 along = q.vertices[q.ends(side).head] - tail;
    const double part = glm::dot(along, own - tail) / glm::dot(along, along);
    nearest = q.offset + q.posed.linear * (tail + along * std::clamp(part, 0.0, 1.0));
    return part <= 0.0   ? Feature{Kind::Vertex, q.ends(side).tail}
           : part >= 1.0 ? Feature{Kind::Vertex, q.ends(side).head}
                         : Feature{Kind::Edge, side};
}

/// Nearest to the other's middle, and then to the vertex that is furthest that way.
void startCold(const Vclip& walk, Feature& a, Feature& b) {
    const Body& p = walk.a();
    Vec3 nearest(0.0);
    b = featureUnder(walk.b(), p.offset, nearest);
    a = {Kind::Vertex, supportOf(p, nearest - p.offset)};
}

/// Two faces are the one pair that the walk has no rule for.
Feature startFrom(const Feature& feature, const Feature& other, const Shape& shape) {
    return feature.kind == Kind::Face && other.kind == Kind::Face ? Feature{Kind::Vertex, shape.face(feature.index)[0]}
                                                                  : feature;
}

} // namespace

Closest vclipClosest(const PosedShape& a, const PosedShape& b, ClosestSeed& seed, VclipCounts* counts) {
    VclipCounts unused;
    VclipCounts& count = counts != nullptr ? *counts : unused;
    const auto fallBack = [&](int& reason) {
        ++reason;
        const Closest closest = gjkClosest(a, b, seed);
        if (!closest.overlap) {
            seed.has_features = true;
            seed.a = startFrom(closest.feature_a, closest.feature_b, *a.shape);
            seed.b = closest.feature_b;
        }
        return closest;
    };
    if (!a.shape->topology().closed || !b.shape->topology().closed) {
        return fallBack(count.open);
    }
    Vclip walk(a, b);
    Feature at_a = startFrom(seed.a, seed.b, *a.shape);
    Feature at_b = seed.b;
    if (!seed.has_features) {
        startCold(walk, at_a, at_b);
    }
    // A seed from which it is further than this is worse than none.
    constexpr int kFewSteps = 6;
    // Brent: a pair seen again is a cycle, of whatever length.
    Feature mark_a = at_a;
    Feature mark_b = at_b;
    for (int steps = 0, next_mark = 8;; ++steps) {
        ++count.steps;
        const int escapes = walk.escapes();
        const Vclip::Step step = walk.step(at_a, at_b);
        count.escapes += walk.escapes() - escapes;
        if (step == Vclip::Step::Inside) {
            return walk.overlapResult();
        }
        if (step == Vclip::Step::Done) {
            break;
        }
        if (steps == kFewSteps && seed.has_features) {
            startCold(walk, at_a, at_b);
            mark_a = at_a;
            mark_b = at_b;
            continue;
        }
        if (at_a == mark_a && at_b == mark_b) {
            return fallBack(count.cycles);
        }
        if (steps == next_mark) {
            next_mark *= 2;
            mark_a = at_a;
            mark_b = at_b;
        }
    }
    Closest closest = walk.apartResult(at_a, at_b);
    if (!closest.overlap && !prove(walk, closest)) {
        return fallBack(count.unproven);
    }
    seed.has_features = true;
    seed.a = at_a;
    seed.b = at_b;
    return closest;
}

} // namespace elastoon
