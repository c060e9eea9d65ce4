// The solids, as points handed to the hull; their frames are laid by the solids' own symmetry. See shape.h.
#include "elastoon/shape.h"

#include "check_input.h"
#include "dmath.h"
#include "hash.h"
#include "shape_parts.h"
#include "support.h"
#include "topology.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

namespace elastoon {

namespace {

/// Up to this many, looking at all is as quick as climbing.
constexpr std::size_t kFewVertices = 16;

std::optional<Error> checkSize(double value, const char* what) {
    if (std::isfinite(value) && value >= Shape::kMinSize && value <= Shape::kMaxSize) {
        return std::nullopt;
    }
    return Error{std::string("must be a length from 1e-9 to 1e9 m, is ") + shortNumber(value), what};
}

std::optional<Error> checkSides(int value, int least, int most, int step, const char* what) {
    if (value >= least && value <= most && value % step == 0) {
        return std::nullopt;
    }
    return Error{"must be a multiple of " + std::to_string(step) + " from " + std::to_string(least) + " to " +
                     std::to_string(most) + ", is " + std::to_string(value),
                 what};
}

/// Corner i of n on the unit circle; the four on the axes are exact.
std::array<double, 2> onCircle(int i, int n) {
    const int quarter = n / 4;
    const SinCos within = detSinCos(0.5 * kPi * (i % quarter) / quarter);
    const double c = i % quarter == 0 ? 1.0 : within.cos;
    const double s = i % quarter == 0 ? 0.0 : within.sin;
    switch (i / quarter % 4) {
    case 0:
        return {c, s};
    case 1:
        return {-s, c};
    case 2:
        return {-c, -s};
    default:
        return {s, -c};
    }
}

void addRing(std::vector<Vec3>& points, double x, double radius, int sides) {
    for (int i = 0; i < sides; ++i) {
        const auto [c, s] = onCircle(i, sides);
        points.emplace_back(x, radius * c, radius * s);
    }
}

/// Point of the octahedron's edge-cut lattice, drawn out to the unit sphere.
Vec3 onSphere(int a, int b, int c) {
    return glm::normalize(Vec3(a, b, c));
}

} // namespace

std::string_view nameOf(ShapeKind kind) {
    constexpr std::string_view kNames[] = {"sphere", "box", "cylinder", "cone", "capsule", "hull"};
    return kNames[static_cast<std::size_t>(kind)];
}

Result<ShapePtr> Shape::sphere(double radius, int cuts) {
    if (auto error = checkSize(radius, "radius")) {
        return *error;
    }
    if (auto error = checkSides(cuts, 2, 64, 2, "cuts")) {
        return *error;
    }
    std::vector<Vec3> points;
    for (int x = -cuts; x <= cuts; ++x) {
        const int left = cuts - std::abs(x);
        for (int y = -left; y <= left; ++y) {
            const int z = left - std::abs(y);
            points.push_back(onSphere(x, y, z) * radius);
            if (z != 0) {
                points.push_back(onSphere(x, y, -z) * radius);
            }
        }
    }
    return fromPoints(ShapeKind::Sphere, std::move(points), radius);
}

Result<ShapePtr> Shape::box(const Vec3& size) {
    for (int axis = 0; axis < 3; ++axis) {
        if (auto error = checkSize(size[axis], "size")) {
            return *error;
        }
    }
    std::vector<Vec3> points;
    for (int corner = 0; corner < 8; ++corner) {
        points.emplace_back((corner & 1) != 0 ? 0.5 * size.x : -0.5 * size.x,
                            (corner & 2) != 0 ? 0.5 * size.y : -0.5 * size.y,
                            (corner & 4) != 0 ? 0.5 * size.z : -0.5 * size.z);
    }
    return fromPoints(ShapeKind::Box, std::move(points), 0.0);
}

Result<ShapePtr> Shape::cylinder(double radius, double length, int sides) {
    for (auto error :
         {checkSize(radius, "radius"), checkSize(length, "length"), checkSides(sides, 8, 256, 4, "sides")}) {
        if (error) {
            return *error;
        }
    }
    std::vector<Vec3> points;
    addRing(points, -0.5 * length, radius, sides);
    addRing(points, 0.5 * length, radius, sides);
    return fromPoints(ShapeKind::Cylinder, std::move(points), radius);
}

Result<ShapePtr> Shape::cone(double radius, double length, int sides) {
    for (auto error :
         {checkSize(radius, "radius"), checkSize(length, "length"), checkSides(sides, 8, 256, 4, "sides")}) {
        if (error) {
            return *error;
        }
    }
    std::vector<Vec3> points;
    addRing(points, -0.25 * length, radius, sides);
    points.emplace_back(0.75 * length, 0.0, 0.0);
    return fromPoints(ShapeKind::Cone, std::move(points), radius);
}

Result<ShapePtr> Shape::capsule(double radius, double length, int sides) {
    for (auto error :
         {checkSize(radius, "radius"), checkSize(length, "length"), checkSides(sides, 8, 64, 4, "sides")}) {
        if (error) {
            return *error;
        }
    }
    if (length < 2.0 * radius) {
        return Error{"must be at least twice the radius (it is measured from tip to tip), is " + shortNumber(length),
                     "length"};
    }
    std::vector<Vec3> points;
    const double middle = 0.5 * length - radius;
    const int rings = sides / 4;
    for (int i = 0; i < rings; ++i) {
        const auto [c, s] = onCircle(i, sides);
        addRing(points, middle + radius * s, radius * c, sides);
        addRing(points, -middle - radius * s, radius * c, sides);
    }
    points.emplace_back(0.5 * length, 0.0, 0.0);
    points.emplace_back(-0.5 * length, 0.0, 0.0);
    return fromPoints(ShapeKind::Capsule, std::move(points), radius);
}

Result<ShapePtr> Shape::hull(std::span<const Vec3> points) {
    return fromPoints(ShapeKind::Hull, {points.begin(), points.end()}, 0.0);
}

Result<ShapePtr> Shape::fromPoints(ShapeKind kind, std::vector<Vec3> points, double radius) {
    auto made = convexHull(points);
    if (!made) {
        return made.error();
    }
    ShapeParts parts{kind, radius, 0.0, Vec3(0.0), std::move(made.value())};
    const MassCenter mass = massCenterOf(parts.polytope);
    parts.volume = mass.volume;
    if (kind == ShapeKind::Hull) {
        parts.centroid_of_input = mass.centroid;
        for (Vec3& vertex : parts.polytope.vertices) {
            vertex -= mass.centroid;
        }
    }
    return fromParts(std::move(parts));
}

namespace {

std::uint64_t hashOf(const ShapeParts& parts) {
    Hash hash;
    const auto addBits = [&](double number) { hash.add(std::bit_cast<std::uint64_t>(number)); };
    const auto addVector = [&](const Vec3& v) {
        addBits(v.x);
        addBits(v.y);
        addBits(v.z);
    };
    hash.add(std::uint64_t{static_cast<std::uint8_t>(parts.kind)});
    addBits(parts.radius);
    addBits(parts.volume);
    addVector(parts.centroid_of_input);
    const Polytope& polytope = parts.polytope;
    hash.add(std::uint64_t{polytope.vertices.size()});
    std::for_each(polytope.vertices.begin(), polytope.vertices.end(), addVector);
    hash.add(std::uint64_t{polytope.face_begin.size()});
    for (const std::uint32_t begin : polytope.face_begin) {
        hash.add(std::uint64_t{begin});
    }
    for (const std::uint32_t vertex : polytope.face_vertices) {
        hash.add(std::uint64_t{vertex});
    }
    return hash.value();
}

} // namespace

ShapePtr Shape::fromParts(ShapeParts parts) {
    const auto shape = std::shared_ptr<Shape>(new Shape);
    shape->content_hash_ = hashOf(parts);
    shape->kind_ = parts.kind;
    shape->radius_ = parts.radius;
    shape->volume_ = parts.volume;
    shape->centroid_of_input_ = parts.centroid_of_input;
    Polytope& polytope = parts.polytope;
    Vec3 low(polytope.vertices.front());
    Vec3 high = low;
    for (const Vec3& vertex : polytope.vertices) {
        low = glm::min(low, vertex);
        high = glm::max(high, vertex);
        shape->bounding_radius_ = std::max(shape->bounding_radius_, glm::length(vertex));
        shape->reach_along_ = std::max(shape->reach_along_, std::fabs(vertex.x));
        shape->reach_across_ = std::max(shape->reach_across_, std::sqrt(vertex.y * vertex.y + vertex.z * vertex.z));
    }
    shape->extents_ = high - low;
    shape->length_ = shape->extents_.x;
    shape->vertices_ = std::move(polytope.vertices);
    shape->face_vertices_ = std::move(polytope.face_vertices);
    shape->face_begin_ = std::move(polytope.face_begin);
    shape->topology_ =
        std::make_shared<const Topology>(topologyOf(shape->vertices_, shape->face_vertices_, shape->face_begin_));
    const bool climbs = shape->topology_->climbable && shape->vertices_.size() > kFewVertices;
    shape->support_table_ = std::make_shared<const SupportTable>(
        climbs ? SupportTable(shape->vertices_, *shape->topology_) : SupportTable());
    return ShapePtr(shape);
}

std::span<const std::uint32_t> Shape::face(std::size_t index) const {
    return std::span(face_vertices_).subspan(face_begin_[index], face_begin_[index + 1] - face_begin_[index]);
}

std::size_t Shape::supportVertex(const Vec3& direction) const {
    return supportOf(*this, direction);
}

} // namespace elastoon
