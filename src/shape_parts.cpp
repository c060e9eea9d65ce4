// See shape_parts.h.
#include "shape_parts.h"

#include "topology.h"

#include <cmath>
#include <string>

namespace elastoon {

ShapeParts ShapeParts::of(const Shape& shape) {
    ShapeParts parts{shape.kind(), shape.radius(), shape.volume(), shape.centroidOfInput(), {}};
    parts.polytope.vertices.assign(shape.vertices().begin(), shape.vertices().end());
    for (std::size_t i = 0; i < shape.faceCount(); ++i) {
        const auto face = shape.face(i);
        parts.polytope.face_vertices.insert(parts.polytope.face_vertices.end(), face.begin(), face.end());
        parts.polytope.face_begin.push_back(static_cast<std::uint32_t>(parts.polytope.face_vertices.size()));
    }
    return parts;
}

namespace {

constexpr double kMostCoordinate = 2.0 * Shape::kMaxSize;
/// Of volumes, by two ways; and of the centroid, as a share of the size.
constexpr double kSameBulk = 1e-6;

const char* flawOfNumbers(const ShapeParts& parts) {
    const auto within = [](double value) { return std::fabs(value) <= kMostCoordinate; };
    const auto allWithin = [&](const Vec3& v) { return within(v.x) && within(v.y) && within(v.z); };
    bool sound = within(parts.radius) && parts.radius >= 0.0 && allWithin(parts.centroid_of_input);
    for (const Vec3& vertex : parts.polytope.vertices) {
        sound = sound && allWithin(vertex);
    }
    return sound ? nullptr : "its numbers must be finite and within +-2e9 m";
}

const char* flawOfFaces(const Polytope& polytope) {
    const auto& begin = polytope.face_begin;
    if (begin.size() < 5 || begin.front() != 0 || begin.back() != polytope.face_vertices.size()) {
        return "its faces must be at least 4 and use all of the list of corners";
    }
    std::vector<bool> used(polytope.vertices.size(), false);
    for (std::size_t i = 0; i + 1 < begin.size(); ++i) {
        if (begin[i + 1] > begin.back() || begin[i + 1] < begin[i] + 3) {
            return "a face must have at least 3 corners";
        }
    }
    for (const std::uint32_t vertex : polytope.face_vertices) {
        if (vertex >= used.size()) {
            return "a face names a vertex that is not there";
        }
        used[vertex] = true;
    }
    for (const bool is_used : used) {
        if (!is_used) {
            return "every vertex must belong to a face";
        }
    }
    return nullptr;
}

} // namespace

std::optional<Error> ShapeParts::flaw() const {
    const auto told = [](const char* what) { return Error{what, "shape"}; };
    if (kind > ShapeKind::Hull) {
        return told("its kind must be one of the six");
    }
    if (const char* what = flawOfNumbers(*this)) {
        return told(what);
    }
    if (const char* what = flawOfFaces(polytope)) {
        return told(what);
    }
    if (!topologyOf(polytope.vertices, polytope.face_vertices, polytope.face_begin).closed) {
        return told("its faces must close to one surface");
    }
    const auto hull = convexHull(polytope.vertices);
    if (!hull) {
        return hull.error();
    }
    // A closed surface that holds as much as its own hull is convex.
    const MassCenter mass = massCenterOf(polytope);
    const MassCenter mass_of_hull = massCenterOf(hull.value());
    double size = 0.0;
    for (const Vec3& vertex : polytope.vertices) {
        size = std::max(size, glm::length(vertex));
    }
    if (!(std::fabs(mass.volume - mass_of_hull.volume) <= kSameBulk * mass_of_hull.volume &&
          std::fabs(volume - mass.volume) <= kSameBulk * mass.volume)) {
        return told("its faces must bound the convex hull of its vertices, with the volume that it names");
    }
    if (!(glm::length(mass.centroid) <= kSameBulk * size)) {
        return told("its volume's centroid must be the origin");
    }
    return std::nullopt;
}

} // namespace elastoon
