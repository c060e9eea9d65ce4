// libFuzzer target: bytes as two posed solids and where the walks start; V-Clip and GJK end, agree, and prove what they
// say. scripts/fuzz.sh runs it.
#include "bytes.h"
#include "closest_judge.h"
#include "gjk.h"
#include "vclip.h"

#include <string>
#include <vector>

namespace elastoon {
namespace {

constexpr double kTolerance = 1e-9;
/// GJK's rounding is of the squared distance: nearer than this times the size it is held to ten times the tolerance, as
/// in its tests.
constexpr double kNearTouching = 1e-5;
/// Size of the larger body by the thickness of the thinner: what is beyond must end with numbers, no more.
constexpr double kMostUnequal = 1e6;

/// 0 to 1.
double share(Bytes& bytes) {
    return (bytes.next() * 256.0 + bytes.next()) / 65535.0;
}

double between(Bytes& bytes, double low, double high) {
    return low + (high - low) * share(bytes);
}

/// 10^low to 10^high.
double power(Bytes& bytes, double low, double high) {
    return std::pow(10.0, between(bytes, low, high));
}

Vec3 inBox(Bytes& bytes) {
    const double x = between(bytes, -1.0, 1.0);
    const double y = between(bytes, -1.0, 1.0);
    return {x, y, between(bytes, -1.0, 1.0)};
}

Vec3 direction(Bytes& bytes) {
    const Vec3 v = inBox(bytes);
    const double length = glm::length(v);
    return length > 0.1 ? v / length : Vec3(0.0, 1.0, 0.0);
}

ShapePtr library(std::size_t index) {
    static const std::vector<ShapePtr> kShapes = [] {
        const std::vector<Vec3> tetrahedron{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
        const std::vector<Vec3> prism{{-1, 0, 0}, {-1, 1, 0}, {-1, 0, 1}, {1, 0, 0}, {1, 1, 0}, {1, 0, 1}};
        return std::vector<ShapePtr>{Shape::box({1, 1, 1}).value(),        Shape::hull(tetrahedron).value(),
                                     Shape::hull(prism).value(),           Shape::box({2, 1, 0.25}).value(),
                                     Shape::cylinder(0.5, 1.5, 8).value(), Shape::cylinder(0.5, 1.0, 32).value(),
                                     Shape::cone(0.5, 1.0, 12).value(),    Shape::capsule(0.25, 1.0, 8).value(),
                                     Shape::sphere(0.5, 2).value(),        Shape::sphere(0.5, 4).value(),
                                     Shape::sphere(0.5, 8).value(),        Shape::box({1, 1e-3, 1}).value(),
                                     Shape::box({1, 1e-3, 1e-3}).value()};
    }();
    return kShapes[index % kShapes.size()];
}

/// A hull of few points: a coarse lattice makes it flat here and there, raw numbers make it anything.
ShapePtr hullFrom(Bytes& bytes, bool lattice) {
    std::vector<Vec3> points;
    const int count = 4 + bytes.next() % 13;
    const auto number = [&] { return lattice ? 0.25 * (bytes.next() % 9 - 4) : coordinate(bytes); };
    for (int i = 0; i < count; ++i) {
        const double x = number();
        const double y = number();
        points.emplace_back(x, y, number());
    }
    const auto shape = Shape::hull(points);
    return shape ? shape.value() : nullptr;
}

ShapePtr shapeFrom(Bytes& bytes) {
    const std::uint8_t kind = bytes.next();
    return kind < 200 ? library(kind) : hullFrom(bytes, kind < 240);
}

Mat3 rotationFrom(Bytes& bytes) {
    const std::uint8_t kind = bytes.next();
    if (kind < 120) {
        return latticeRotation(kind % 24);
    }
    if (kind < 160) {
        // Parallel but for a hair.
        const double angle = power(bytes, -17.0, -2.0);
        return glm::mat3_cast(glm::angleAxis(angle, direction(bytes))) * latticeRotation(kind % 24);
    }
    return glm::mat3_cast(glm::angleAxis(between(bytes, 0.0, 3.2), direction(bytes)));
}

Mat3 linearFrom(Bytes& bytes) {
    Mat3 linear = rotationFrom(bytes);
    const std::uint8_t kind = bytes.next();
    constexpr double kExact[] = {1.0, 0.25, 4.0, 0.05, 5.0};
    const double stretch = kind < 128 ? kExact[kind % 5] : power(bytes, std::log10(0.05), std::log10(5.0));
    // Two in eight are of another size.
    const double size = kind % 8 == 6   ? std::exp2(bytes.next() % 21 - 10)
                        : kind % 8 == 7 ? power(bytes, -3.0, 3.0)
                                        : 1.0;
    const Vec3 scale = size * scaleOf(stretch);
    for (int i = 0; i < 3; ++i) {
        linear[i] *= scale[i];
    }
    return linear;
}

/// Where a stands to b: on a lattice, in front of it by a little more or less than touching, somewhere, or far away.
Vec3 offsetFrom(Bytes& bytes, const PosedShape& a, const PosedShape& b) {
    const std::uint8_t kind = bytes.next();
    const auto quarter = [&] { return 0.25 * static_cast<std::int8_t>(bytes.next()) / (kind % 2 == 0 ? 1.0 : 8.0); };
    if (kind < 80) {
        const double x = quarter();
        const double y = quarter();
        return {x, y, quarter()};
    }
    if (kind < 220) {
        const Vec3 way = kind < 140 ? direction(bytes) : latticeRotation(kind % 24)[0];
        const double touching = reachOf(a, -way) + reachOf(b, way);
        const double off = kind % 3 == 0 ? power(bytes, -17.0, -1.0) : kind % 3 == 1 ? -power(bytes, -17.0, -1.0) : 0.0;
        return (touching * (kind % 5 == 0 ? between(bytes, 0.0, 1.5) : 1.0 + off)) * way;
    }
    return (kind < 240 ? 3.0 : power(bytes, -6.0, 6.0)) * inBox(bytes);
}

std::uint32_t countOf(const Shape& shape, Feature::Kind kind) {
    return static_cast<std::uint32_t>(kind == Feature::Kind::Vertex ? shape.vertices().size()
                                      : kind == Feature::Kind::Edge ? shape.topology().edges.size()
                                                                    : shape.faceCount());
}

Feature featureFrom(Bytes& bytes, const Shape& shape) {
    const auto kind = static_cast<Feature::Kind>(bytes.next() % 3);
    const std::uint32_t index = bytes.next() * 256U + bytes.next();
    return {kind, index % countOf(shape, kind)};
}

/// Any features and vertices that the bodies have, whatever they have to do with where the bodies are.
ClosestSeed seedFrom(Bytes& bytes, const PosedShape& a, const PosedShape& b) {
    ClosestSeed seed;
    const std::uint8_t kind = bytes.next();
    seed.has_features = kind % 4 != 0;
    if (seed.has_features) {
        seed.a = featureFrom(bytes, *a.shape);
        seed.b = featureFrom(bytes, *b.shape);
    }
    seed.pair_count = kind / 4 % 5;
    for (std::size_t i = 0; i < seed.pair_count; ++i) {
        seed.pairs_a[i] = bytes.next() % static_cast<std::uint32_t>(a.shape->vertices().size());
        seed.pairs_b[i] = bytes.next() % static_cast<std::uint32_t>(b.shape->vertices().size());
    }
    return seed;
}

double toSegment(const Vec3& point, const Vec3& from, const Vec3& to) {
    const Vec3 along = to - from;
    const double part = std::clamp(glm::dot(point - from, along) / glm::dot(along, along), 0.0, 1.0);
    return glm::length(point - (from + part * along));
}

/// How far the point is from the feature that it is said to be on.
double offFeature(const PosedShape& body, const Feature& feature, const Vec3& point) {
    const auto at = [&](std::uint32_t vertex) { return worldOf(body, body.shape->vertices()[vertex]); };
    demand(feature.index < countOf(*body.shape, feature.kind), "a feature that is none");
    if (feature.kind == Feature::Kind::Vertex) {
        return glm::length(point - at(feature.index));
    }
    if (feature.kind == Feature::Kind::Edge) {
        const Topology::Edge& edge = body.shape->topology().edges[feature.index];
        return toSegment(point, at(edge.tail), at(edge.head));
    }
    const Vec3 normal = faceNormal(body, feature.index);
    const auto loop = body.shape->face(feature.index);
    double border = std::numeric_limits<double>::infinity();
    bool above = true;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec3 from = at(loop[i]);
        const Vec3 to = at(loop[(i + 1) % loop.size()]);
        above = above && glm::dot(glm::cross(normal, to - from), point - from) >= 0.0;
        border = std::min(border, toSegment(point, from, to));
    }
    return above ? std::fabs(glm::dot(normal, point - at(loop[0]))) : border;
}

double distanceOf(const Closest& closest) {
    return closest.overlap ? 0.0 : closest.distance;
}

void judge(const Closest& closest, const PosedShape& a, const PosedShape& b, double tolerance, const char* method) {
    const std::string flaw = flawOf(closest, a, b, tolerance);
    demand(flaw.empty(), (method + (": " + flaw)).c_str());
    if (!closest.overlap) {
        const double off = std::max(offFeature(a, closest.feature_a, closest.point_a),
                                    offFeature(b, closest.feature_b, closest.point_b));
        demand(off <= tolerance, (method + (": a point is off its feature by " + shown(off))).c_str());
    }
}

bool isWithinReason(const PosedShape& a, const PosedShape& b) {
    return sizeOf(a, b) <= kMostUnequal * std::min(thicknessOf(a), thicknessOf(b));
}

struct Seeds {
    ClosestSeed vclip, gjk;
};

void compare(const PosedShape& a, const PosedShape& b, Seeds& seeds) {
    const double tolerance = kTolerance * sizeOf(a, b) + 1e-13 * glm::length(a.position - b.position);
    const Closest closest = vclipClosest(a, b, seeds.vclip);
    const Closest other = gjkClosest(a, b, seeds.gjk);
    demand(std::isfinite(closest.distance) && std::isfinite(other.distance), "a distance that is not finite");
    if (!isWithinReason(a, b)) {
        return;
    }
    judge(closest, a, b, tolerance, "V-Clip");
    const double of_gjk = distanceOf(other) < kNearTouching * sizeOf(a, b) ? 10.0 * tolerance : tolerance;
    judge(other, a, b, of_gjk, "GJK");
    demand(std::fabs(distanceOf(closest) - distanceOf(other)) <= of_gjk, "V-Clip and GJK disagree");
}

/// From every pair of features, where there are not too many.
void compareAllStarts(const PosedShape& a, const PosedShape& b) {
    ClosestSeed cold;
    const double distance = distanceOf(vclipClosest(a, b, cold));
    const double tolerance = kTolerance * sizeOf(a, b) + 1e-13 * glm::length(a.position - b.position);
    for (const auto kind_a : {Feature::Kind::Vertex, Feature::Kind::Edge, Feature::Kind::Face}) {
        for (const auto kind_b : {Feature::Kind::Vertex, Feature::Kind::Edge, Feature::Kind::Face}) {
            for (std::uint32_t i = 0; i < countOf(*a.shape, kind_a); ++i) {
                for (std::uint32_t j = 0; j < countOf(*b.shape, kind_b); ++j) {
                    ClosestSeed seed;
                    seed.has_features = true;
                    seed.a = {kind_a, i};
                    seed.b = {kind_b, j};
                    demand(std::fabs(distanceOf(vclipClosest(a, b, seed)) - distance) <= tolerance,
                           "the distance depends on the start");
                }
            }
        }
    }
}

void runOn(Bytes& bytes) {
    const ShapePtr shape_a = shapeFrom(bytes);
    const ShapePtr shape_b = shapeFrom(bytes);
    if (!shape_a || !shape_b) {
        return;
    }
    PosedShape a{shape_a.get(), linearFrom(bytes), Vec3(0.0)};
    PosedShape b{shape_b.get(), linearFrom(bytes), Vec3(0.0)};
    a.position = offsetFrom(bytes, a, b);
    const std::uint8_t mode = bytes.next();
    if (mode % 4 == 3) {
        // Turned and shifted together: parallel to within rounding, in no special direction.
        const Mat3 turn = glm::mat3_cast(glm::angleAxis(between(bytes, 0.0, 3.2), direction(bytes)));
        b.position = 10.0 * inBox(bytes);
        a.position = b.position + turn * a.position;
        a.linear = turn * a.linear;
        b.linear = turn * b.linear;
    }
    const ClosestSeed start = seedFrom(bytes, a, b);
    Seeds seeds{start, start};
    compare(a, b, seeds);
    const std::size_t features = shape_a->topology().edges.size() * shape_b->topology().edges.size();
    if (mode >= 192 && features <= 300 && isWithinReason(a, b)) {
        compareAllStarts(a, b);
    }
    // Onward with the seeds kept, as bodies that move.
    for (int i = 0; i < 4 && bytes.any(); ++i) {
        a.position += (sizeOf(a, b) * power(bytes, -6.0, 0.0)) * inBox(bytes);
        compare(a, b, seeds);
    }
}

} // namespace
} // namespace elastoon

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    elastoon::Bytes bytes(data, size);
    elastoon::runOn(bytes);
    return 0;
}
