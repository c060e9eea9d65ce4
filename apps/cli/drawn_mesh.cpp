// See drawn_mesh.h.
#include "drawn_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace elastoon {

namespace {

constexpr std::size_t kColumns = 96;   // about the x axis
constexpr std::size_t kWedges = 6;     // of a beach ball
constexpr std::size_t kBallRows = 64;  // from pole to pole
constexpr std::size_t kManyFaces = 64; // a hull with more is painted in wedges instead of panels

/// Gathers triangles. With pattern off, every tint becomes Main.
class MeshBuilder {
public:
    explicit MeshBuilder(bool patterned) : patterned_(patterned) {}

    std::uint32_t vertex(const Vec3& position, const Vec3& normal) {
        mesh_.positions.push_back(narrow(position));
        mesh_.normals.push_back(narrow(normal));
        return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
    }
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, Tint tint) {
        mesh_.triangles.push_back({a, b, c});
        mesh_.tints.push_back(patterned_ ? tint : Tint::Main);
    }
    /// A flat convex polygon, counter-clockwise seen from outside.
    void polygon(const std::vector<Vec3>& corners, const Vec3& normal, Tint tint) {
        std::vector<std::uint32_t> indices;
        for (const Vec3& corner : corners) {
            indices.push_back(vertex(corner, normal));
        }
        for (std::size_t i = 2; i < indices.size(); ++i) {
            triangle(indices[0], indices[i - 1], indices[i], tint);
        }
    }
    DrawnMesh take() { return std::move(mesh_); }

private:
    static std::array<float, 3> narrow(const Vec3& v) {
        return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    }

    DrawnMesh mesh_;
    bool patterned_;
};

/// A point of the curve that is turned about the x axis, and the normal there.
struct ProfilePoint {
    double x = 0.0, radius = 0.0;
    double normal_x = 0.0, normal_radial = 1.0;
};

/// A stretch of the curve, from +x towards -x, with one smooth normal and one painting.
struct Band {
    std::vector<ProfilePoint> points;
    bool wedged = false;
    Tint tint = Tint::Main; ///< where it is not wedged
};

Vec3 turned(double x, double radius, std::size_t column) {
    // A whole turn ends on the very floats it began with, so that the surface closes.
    const double angle =
        2.0 * std::numbers::pi * static_cast<double>(column % kColumns) / static_cast<double>(kColumns);
    return {x, radius * std::cos(angle), radius * std::sin(angle)};
}

void addPatch(MeshBuilder& builder, const Band& band, std::size_t first_column, std::size_t last_column, Tint tint) {
    const std::size_t width = last_column - first_column + 1;
    std::vector<std::uint32_t> grid;
    for (const ProfilePoint& point : band.points) {
        for (std::size_t column = first_column; column <= last_column; ++column) {
            grid.push_back(builder.vertex(turned(point.x, point.radius, column),
                                          turned(point.normal_x, point.normal_radial, column)));
        }
    }
    for (std::size_t row = 0; row + 1 < band.points.size(); ++row) {
        for (std::size_t column = 0; column + 1 < width; ++column) {
            const std::uint32_t a = grid[row * width + column];
            const std::uint32_t b = grid[row * width + column + 1];
            const std::uint32_t c = grid[(row + 1) * width + column];
            const std::uint32_t d = grid[(row + 1) * width + column + 1];
            if (band.points[row].radius > 0.0) {
                builder.triangle(a, c, b, tint);
            }
            if (band.points[row + 1].radius > 0.0) {
                builder.triangle(b, c, d, tint);
            }
        }
    }
}

DrawnMesh turnedMesh(const std::vector<Band>& bands, bool patterned) {
    MeshBuilder builder(patterned);
    constexpr std::size_t kWedgeColumns = kColumns / kWedges;
    for (const Band& band : bands) {
        for (std::size_t wedge = 0; wedge < kWedges; ++wedge) {
            const Tint stripe = wedge % 2 == 0 ? Tint::Main : Tint::Light;
            addPatch(builder, band, wedge * kWedgeColumns, (wedge + 1) * kWedgeColumns,
                     band.wedged ? stripe : band.tint);
        }
    }
    return builder.take();
}

/// Arc of a circle about (centre, 0), rows first..last of kBallRows from the +x pole to the -x pole.
std::vector<ProfilePoint> arc(double centre, double radius, std::size_t first, std::size_t last) {
    std::vector<ProfilePoint> points;
    for (std::size_t row = first; row <= last; ++row) {
        const double angle = std::numbers::pi * static_cast<double>(row) / static_cast<double>(kBallRows);
        const bool pole = row == 0 || row == kBallRows;
        const double along = row == kBallRows / 2 ? 0.0 : std::cos(angle);
        const double across = pole ? 0.0 : std::sin(angle);
        points.push_back({centre + radius * along, radius * across, along, across});
    }
    return points;
}

// The +x end wears a plain cap and the -x end a ring: one sees which end leads.
constexpr std::size_t kCapEnd = 7, kRingBegin = 54, kRingEnd = 60;

std::vector<Band> sphereBands(double radius) {
    return {{arc(0.0, radius, 0, kCapEnd), false, Tint::Accent},
            {arc(0.0, radius, kCapEnd, kRingBegin), true},
            {arc(0.0, radius, kRingBegin, kRingEnd), false, Tint::Accent},
            {arc(0.0, radius, kRingEnd, kBallRows), false, Tint::Light}};
}

std::vector<Band> capsuleBands(double radius, double length) {
    constexpr std::size_t kEquator = kBallRows / 2;
    const double centre = std::max(0.0, length / 2.0 - radius);
    std::vector<Band> bands{{arc(centre, radius, 0, 2 * kCapEnd), false, Tint::Accent},
                            {arc(centre, radius, 2 * kCapEnd, kEquator), true}};
    if (centre > 0.0) {
        bands.push_back({{{centre, radius}, {-centre, radius}}, true});
    }
    bands.push_back({arc(-centre, radius, kEquator, kRingBegin - kCapEnd), true});
    bands.push_back({arc(-centre, radius, kRingBegin - kCapEnd, kRingEnd - kCapEnd / 2), false, Tint::Accent});
    bands.push_back({arc(-centre, radius, kRingEnd - kCapEnd / 2, kBallRows), false, Tint::Light});
    return bands;
}

/// A flat end at x that faces `side` (+1 or -1): an outer ring and a middle.
void addEnd(std::vector<Band>& bands, double x, double radius, double side, Tint ring, Tint middle) {
    constexpr double kMiddle = 0.6;
    const ProfilePoint rim{x, radius, side, 0.0}, border{x, kMiddle * radius, side, 0.0}, centre{x, 0.0, side, 0.0};
    if (side > 0.0) {
        bands.push_back({{centre, border}, false, middle});
        bands.push_back({{border, rim}, false, ring});
    } else {
        bands.push_back({{rim, border}, false, ring});
        bands.push_back({{border, centre}, false, middle});
    }
}

std::vector<Band> cylinderBands(double radius, double length) {
    const double half = length / 2.0;
    const double band_begin = half * 0.78, band_end = half * 0.52; // off the middle: tells the ends apart
    std::vector<Band> bands;
    addEnd(bands, half, radius, 1.0, Tint::Accent, Tint::Accent);
    bands.push_back({{{half, radius}, {band_begin, radius}}, true});
    bands.push_back({{{band_begin, radius}, {band_end, radius}}, false, Tint::Accent});
    bands.push_back({{{band_end, radius}, {-half, radius}}, true});
    addEnd(bands, -half, radius, -1.0, Tint::Accent, Tint::Light);
    return bands;
}

std::vector<Band> coneBands(double radius, double length) {
    const double slant = std::hypot(radius, length);
    const auto at = [&](double share) { // share 0 at the tip, 1 at the base
        return ProfilePoint{length * (0.75 - share), radius * share, radius / slant, length / slant};
    };
    std::vector<Band> bands{{{at(0.0), at(0.3)}, false, Tint::Accent}, {{at(0.3), at(1.0)}, true}};
    addEnd(bands, at(1.0).x, radius, -1.0, Tint::Accent, Tint::Light);
    return bands;
}

/// One side of a box: a frame and a panel. `normal` lies along an axis.
void addBoxSide(MeshBuilder& builder, const Vec3& half, int axis, double side) {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    const double margin = 0.34 * std::min({half.x, half.y, half.z}); // one for all sides, so that borders meet
    const std::array<double, 4> u{-half[next], margin - half[next], half[next] - margin, half[next]};
    const std::array<double, 4> v{-half[last], margin - half[last], half[last] - margin, half[last]};
    Vec3 normal(0.0);
    normal[axis] = side;
    Tint panel = Tint::Light;
    if (axis == 0) {
        panel = Tint::Accent;
    }
    const Tint frame = axis == 0 && side < 0.0 ? Tint::Light : Tint::Main;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            std::vector<Vec3> corners(4, normal * half[axis]);
            const std::array<std::size_t, 4> is{i, i + 1, i + 1, i};
            const std::array<std::size_t, 4> js{j, j, j + 1, j + 1};
            for (std::size_t k = 0; k < 4; ++k) {
                corners[k][next] = u[is[k]];
                corners[k][last] = v[js[k]];
            }
            if (side < 0.0) {
                std::reverse(corners.begin(), corners.end());
            }
            builder.polygon(corners, normal, i == 1 && j == 1 ? panel : frame);
        }
    }
}

DrawnMesh boxMesh(const Vec3& size, bool patterned) {
    MeshBuilder builder(patterned);
    for (int axis = 0; axis < 3; ++axis) {
        addBoxSide(builder, size / 2.0, axis, 1.0);
        addBoxSide(builder, size / 2.0, axis, -1.0);
    }
    return builder.take();
}

/// Corners of a face, their mean and their plane's normal.
struct FaceOutline {
    std::vector<Vec3> corners;
    Vec3 centre{0.0}, normal{0.0};
};

FaceOutline outlineOf(const Shape& shape, std::size_t face) {
    FaceOutline outline;
    for (const std::uint32_t index : shape.face(face)) {
        outline.corners.push_back(shape.vertices()[index]);
        outline.centre += outline.corners.back();
    }
    outline.centre /= static_cast<double>(outline.corners.size());
    for (std::size_t i = 0; i < outline.corners.size(); ++i) {
        const Vec3& next = outline.corners[(i + 1) % outline.corners.size()];
        outline.normal += glm::cross(outline.corners[i] - outline.centre, next - outline.centre);
    }
    outline.normal = glm::normalize(outline.normal);
    return outline;
}

/// A face with a panel in its middle: accent where it looks towards +x.
void addPanelledFace(MeshBuilder& builder, const FaceOutline& outline) {
    const Tint panel = outline.normal.x > 0.5 ? Tint::Accent : Tint::Light;
    std::vector<Vec3> inner;
    for (const Vec3& corner : outline.corners) {
        inner.push_back(glm::mix(outline.centre, corner, 0.62));
    }
    for (std::size_t i = 0; i < inner.size(); ++i) {
        const std::size_t next = (i + 1) % inner.size();
        builder.polygon({outline.corners[i], outline.corners[next], inner[next], inner[i]}, outline.normal, Tint::Main);
    }
    builder.polygon(inner, outline.normal, panel);
}

Tint wedgeTint(const FaceOutline& outline, double length) {
    if (outline.centre.x > 0.38 * length) {
        return Tint::Accent;
    }
    const double turn = std::atan2(outline.centre.z, outline.centre.y) / (2.0 * std::numbers::pi) + 0.5;
    return static_cast<int>(turn * static_cast<double>(kWedges)) % 2 == 0 ? Tint::Main : Tint::Light;
}

DrawnMesh hullMesh(const Shape& shape, bool patterned) {
    MeshBuilder builder(patterned);
    const bool panels = patterned && shape.faceCount() <= kManyFaces;
    for (std::size_t face = 0; face < shape.faceCount(); ++face) {
        const FaceOutline outline = outlineOf(shape, face);
        if (panels) {
            addPanelledFace(builder, outline);
        } else {
            builder.polygon(outline.corners, outline.normal, wedgeTint(outline, shape.length()));
        }
    }
    return builder.take();
}

} // namespace

DrawnMesh drawnMesh(const Shape& shape, bool patterned) {
    switch (shape.kind()) {
    case ShapeKind::Sphere:
        return turnedMesh(sphereBands(shape.radius()), patterned);
    case ShapeKind::Cylinder:
        return turnedMesh(cylinderBands(shape.radius(), shape.length()), patterned);
    case ShapeKind::Cone:
        return turnedMesh(coneBands(shape.radius(), shape.length()), patterned);
    case ShapeKind::Capsule:
        return turnedMesh(capsuleBands(shape.radius(), shape.length()), patterned);
    case ShapeKind::Box:
        return boxMesh(shape.extents(), patterned);
    case ShapeKind::Hull:
        break;
    }
    return hullMesh(shape, patterned);
}

Vec3 tintColor(Tint tint, const Vec3& body_color) {
    switch (tint) {
    case Tint::Light:
        return glm::mix(Vec3(0.98, 0.96, 0.92), body_color, 0.03);
    case Tint::Accent:
        return body_color * 0.42 + Vec3(0.02, 0.02, 0.045);
    case Tint::Main:
        break;
    }
    return body_color;
}

} // namespace elastoon
