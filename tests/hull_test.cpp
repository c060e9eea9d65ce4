// The hull against its definition and against Qhull, on point sets that break hulls.
#include "hull.h"
#include "orient.h"
#include "test_support.h"

#include <libqhull_r/qhull_ra.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string>

namespace elastoon {
namespace {

using Points = std::vector<Vec3>;
using Long = glm::vec<3, long double>;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

double largestOf(const Points& points) {
    double largest = 0.0;
    for (const Vec3& point : points) {
        largest = std::max({largest, std::fabs(point.x), std::fabs(point.y), std::fabs(point.z)});
    }
    return largest;
}

struct Face {
    std::vector<std::uint32_t> corners;
    Long point{0.0L}, normal{0.0L};
    long double area = 0.0L;

    Points fan; ///< its corners
    /// Above the face's plane, if by more than `play`; else anything up to that. For needles long doubles are too
    /// rough.
    [[nodiscard]] long double distance(const Vec3& p, double play) const {
        const long double rough = glm::dot(normal, Long(p) - point);
        if (std::fabs(rough) <= play || rough < -1e3 * play) {
            return rough;
        }
        return distanceExactly(p);
    }
    [[nodiscard]] long double distanceExactly(const Vec3& p) const {
        long double exact = 0.0L;
        for (std::size_t i = 1; i + 1 < fan.size(); ++i) {
            exact += orientExactly(fan[0], fan[i], fan[i + 1], p);
        }
        return 0.5L * exact / area;
    }
};

std::vector<Face> facesOf(const Polytope& hull) {
    std::vector<Face> faces(hull.face_begin.size() - 1);
    for (std::size_t f = 0; f < faces.size(); ++f) {
        Face& face = faces[f];
        for (std::uint32_t i = hull.face_begin[f]; i < hull.face_begin[f + 1]; ++i) {
            face.corners.push_back(hull.face_vertices[i]);
            face.fan.push_back(hull.vertices[face.corners.back()]);
        }
        const auto at = [&](std::size_t i) {
            return Long(hull.vertices[face.corners[i]]) - Long(hull.vertices[face.corners[0]]);
        };
        Long normal(0.0L);
        for (std::size_t i = 1; i + 1 < face.corners.size(); ++i) {
            normal += glm::cross(at(i), at(i + 1));
        }
        const long double length = glm::length(normal);
        face.point = Long(hull.vertices[face.corners[0]]);
        face.normal = length > 0.0L ? normal / length : Long(0.0L);
        face.area = 0.5L * length;
    }
    return faces;
}

double surfaceOf(const Polytope& hull) {
    long double area = 0.0L;
    for (const Face& face : facesOf(hull)) {
        area += face.area;
    }
    return static_cast<double>(area);
}

/// Closed, convex, with simple convex loops that lie in their planes, Euler's formula, all given points inside; all
/// within `play`. Convexity is looked at across every edge, which with closedness is enough; points are sampled where
/// there are too many.
void expectHullOf(const Polytope& hull, const Points& points, double play) {
    const std::vector<Face> faces = facesOf(hull);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> face_at;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const auto& corners = faces[f].corners;
        EXPECT_GE(corners.size(), 3U);
        EXPECT_GT(faces[f].area, 0.0L);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const auto next = corners[(i + 1) % corners.size()];
            EXPECT_TRUE(face_at.emplace(std::pair(corners[i], next), f).second) << "an edge has two faces on one side";
        }
    }
    long double highest = 0.0L;
    long double hollow = 0.0L;
    for (const auto& [edge, f] : face_at) {
        const auto back = face_at.find({edge.second, edge.first});
        if (back == face_at.end()) {
            ADD_FAILURE() << "the surface is open";
            return;
        }
        for (const std::uint32_t corner : faces[back->second].corners) {
            highest = std::max(highest, faces[f].distance(hull.vertices[corner], play));
        }
    }
    for (const Face& face : faces) {
        for (std::size_t i = 0; i < face.corners.size(); ++i) {
            const auto at = [&](std::size_t j) {
                return Long(hull.vertices[face.corners[(i + j) % face.corners.size()]]);
            };
            const long double bend = glm::dot(face.normal, glm::cross(at(1) - at(0), at(2) - at(1)));
            hollow = std::max(hollow, -bend / glm::length(at(2) - at(0)));
            highest = std::max(highest, std::fabs(face.distanceExactly(hull.vertices[face.corners[i]])));
        }
    }
    EXPECT_LE(highest, play) << "a face is not flat, or an edge bends inwards";
    EXPECT_LE(hollow, play) << "a face is not convex";
    EXPECT_EQ(hull.vertices.size() + faces.size(), face_at.size() / 2 + 2) << "Euler";
    const std::size_t stride = 1 + points.size() * faces.size() / 3000000;
    long double outside = 0.0L;
    for (std::size_t i = 0; i < points.size(); i += stride) {
        for (const Face& face : faces) {
            outside = std::max(outside, face.distance(points[i], play));
        }
    }
    EXPECT_LE(outside, play) << "a point is outside";
}

struct QhullAnswer {
    double volume = 0.0;
    std::set<std::size_t> vertices;
};

QhullAnswer byQhull(const Points& points) {
    QhullAnswer answer;
    qhT state;
    qhT* qh = &state;
    qh_zero(qh, stderr);
    std::vector<double> coordinates;
    for (const Vec3& point : points) {
        coordinates.insert(coordinates.end(), {point.x, point.y, point.z});
    }
    char options[] = "qhull Qt Pp";
    FILE* nowhere = std::fopen("/dev/null", "w");
    if (qh_new_qhull(qh, 3, static_cast<int>(points.size()), coordinates.data(), False, options, nowhere, nowhere) ==
        0) {
        // Its own sum of volumes is too rough for needles.
        for (facetT* facet = qh->facet_list; facet != nullptr && facet->next != nullptr; facet = facet->next) {
            const auto corner = [&](int i) {
                const auto* vertex = static_cast<vertexT*>(facet->vertices->e[i].p);
                return points[static_cast<std::size_t>(qh_pointid(qh, vertex->point))];
            };
            const double part = orientExactly(corner(0), corner(1), corner(2), points[0]) / 6.0;
            answer.volume += facet->toporient != 0 ? -part : part;
        }
        answer.volume = std::fabs(answer.volume);
        for (vertexT* vertex = qh->vertex_list; vertex != nullptr && vertex->next != nullptr; vertex = vertex->next) {
            answer.vertices.insert(static_cast<std::size_t>(qh_pointid(qh, vertex->point)));
        }
    }
    qh_freeqhull(qh, !qh_ALL);
    int left = 0;
    int total = 0;
    qh_memfreeshort(qh, &left, &total);
    std::fclose(nowhere);
    return answer;
}

std::set<std::size_t> verticesAmong(const Polytope& hull, const Points& points) {
    std::set<std::size_t> found;
    std::size_t next = 0;
    for (const Vec3& vertex : hull.vertices) {
        while (next < points.size() && points[next] != vertex) {
            ++next;
        }
        EXPECT_LT(next, points.size()) << "a vertex is no given point, or out of order";
        found.insert(next);
    }
    return found;
}

enum class Vertices : std::uint8_t { Any, SameAsQhull };

/// The hull is one, and has Qhull's volume.
Polytope expectGoodHull(const Points& points, const std::string& what, Vertices compare = Vertices::Any) {
    SCOPED_TRACE(what);
    auto made = convexHull(points);
    if (!made) {
        ADD_FAILURE() << made.error().text();
        return {};
    }
    Polytope& hull = made.value();
    const MassCenter mass = massCenterOf(hull);
    EXPECT_GT(mass.volume, 0.0);
    const double magnitude = largestOf(points);
    const double area = surfaceOf(hull);
    const double thickness = 3.0 * mass.volume / area;
    const double play = 1e-10 * thickness + 16.0 * kEpsilon * magnitude;
    expectHullOf(hull, points, play);
    const QhullAnswer other = byQhull(points);
    EXPECT_NEAR(mass.volume, other.volume, 1e-9 * other.volume + 8.0 * kEpsilon * magnitude * area);
    const auto vertices = verticesAmong(hull, points);
    if (compare == Vertices::SameAsQhull) {
        EXPECT_EQ(vertices, other.vertices);
    }
    return hull;
}

Points cloud(Random& random, int count, int kind) {
    Points points;
    for (int i = 0; i < count; ++i) {
        const Vec3 direction = random.direction();
        const double radius = kind == 0 ? std::cbrt(random.uniform(0.0, 1.0)) : 1.0;
        points.push_back(kind == 2 ? random.inBox(1.0) : radius * direction);
    }
    return points;
}

Points transformed(const Points& points, const Quat& rotation, const Vec3& scale, const Vec3& offset) {
    Points out;
    for (const Vec3& point : points) {
        out.push_back(offset + rotation * (scale * point));
    }
    return out;
}

Points grid(int nx, int ny, int nz) {
    Points points;
    for (int x = 0; x < nx; ++x) {
        for (int y = 0; y < ny; ++y) {
            for (int z = 0; z < nz; ++z) {
                points.emplace_back(x, y, z);
            }
        }
    }
    return points;
}

/// Prism over a regular polygon; `tips` 1: a cone, 2: a spindle, instead of the second ring.
Points prism(int sides, int tips) {
    Points points;
    for (int i = 0; i < sides; ++i) {
        const double angle = 2.0 * 3.14159265358979323846 * i / sides;
        points.emplace_back(0.0, std::cos(angle), std::sin(angle));
        if (tips == 0) {
            points.emplace_back(1.0, std::cos(angle), std::sin(angle));
        }
    }
    if (tips > 0) {
        points.emplace_back(1.0, 0.0, 0.0);
    }
    if (tips > 1) {
        points.emplace_back(-1.0, 0.0, 0.0);
    }
    return points;
}

TEST(Hull, HasQhullsVerticesOnRandomPoints) {
    Random random(11);
    for (int i = 0; i < 150 * soak(); ++i) {
        const int kind = i % 3;
        const double size = std::pow(10.0, random.uniform(-8.0, 8.0));
        Points points = cloud(random, 5 + random.below(i % 10 == 0 ? 3000 : 200), kind);
        const Vec3 offset = i % 4 == 0 ? random.inBox(1e3 * size) : Vec3(0.0);
        points = transformed(points, random.rotation(), Vec3(size), glm::clamp(offset, -5e8, 5e8));
        expectGoodHull(points, "cloud " + std::to_string(i), Vertices::SameAsQhull);
    }
}

TEST(Hull, HasQhullsVerticesOnManyPoints) {
    Random random(12);
    expectGoodHull(cloud(random, 20000, 0), "ball", Vertices::SameAsQhull);
    expectGoodHull(cloud(random, 5000, 1), "sphere", Vertices::SameAsQhull);
    expectGoodHull(cloud(random, 20000, 2), "cube", Vertices::SameAsQhull);
}

TEST(Hull, OfSlabsAndNeedles) {
    Random random(13);
    for (int i = 0; i < 60 * soak(); ++i) {
        const double thin = std::pow(10.0, random.uniform(-6.0, -1.0));
        const Vec3 scale = i % 2 == 0 ? Vec3(1.0, 1.0, thin) : Vec3(1.0, thin, thin);
        const Quat rotation = i % 3 == 0 ? kNoRotation : random.rotation();
        const std::string what = "thin " + std::to_string(i);
        expectGoodHull(transformed(cloud(random, 200, i % 3), rotation, scale, Vec3(0.0)), what + " cloud");
        const Polytope box = expectGoodHull(transformed(grid(3, 4, 5), rotation, scale, Vec3(0.0)), what + " grid");
        EXPECT_EQ(box.vertices.size(), 8U) << what;
        EXPECT_EQ(box.face_begin.size(), 7U) << what;
        const Polytope can = expectGoodHull(transformed(prism(48, 0), rotation, scale, Vec3(0.0)), what + " prism");
        EXPECT_EQ(can.vertices.size(), 96U) << what;
        EXPECT_EQ(can.face_begin.size(), 51U) << what;
    }
}

TEST(Hull, HoldsThePointsAboutAKnifesEdge) {
    // (0, 0, 0), found by fuzzing: above a facet by rounding only until a facet comes that meets it at a sharp angle.
    const Points needle = {
        {-4.0800000000110001e-05, -7.4399999999980016e-05, -2.9999999999900007e-05},
        {-2.9893634000068048e-05, 3.2253387999876034e-05, -3.9333060000050065e-05},
        {-11.000006800000005, 1.9999876000000012, 9.999995000000002},
        {-7.6000000001100034e-06, 8.2000000000199962e-06, -9.9999999999000018e-06},
        {-0.73338173333333367, 0.1332671333333334, 0.66662666666666681},
        {0, 0, 0},
    };
    expectGoodHull(needle, "found");
    // Likewise: corners of a few small numbers, some moved by about the rounding of the longest side.
    Random random(21);
    int solids = 0;
    for (int i = 0; i < 3000 * soak(); ++i) {
        Points points;
        for (int k = 5 + random.below(12); k > 0; --k) {
            Vec3 point{random.below(3) == 0 ? 15.0 : 0.0, 1.0 * random.below(4), 1.0 * random.below(4)};
            point.x += random.below(2) == 0 ? 0.0 : std::pow(10.0, random.uniform(-16.0, -9.0));
            points.push_back(point * Vec3(1.0, 2e-5, 2e-5));
        }
        points = transformed(points, random.rotation(), Vec3(1.0), Vec3(0.0));
        if (const auto made = convexHull(points)) {
            const double thickness = 3.0 * massCenterOf(made.value()).volume / surfaceOf(made.value());
            SCOPED_TRACE("needle " + std::to_string(i));
            ++solids;
            expectHullOf(made.value(), points, 1e-9 * thickness + 100.0 * kEpsilon * largestOf(points));
        }
    }
    EXPECT_GT(solids, 1500 * soak());
}

TEST(Hull, OfSolidsWithManySides) {
    Random random(14);
    for (const int sides : {3, 8, 100, 1500}) {
        for (int tips = 0; tips < 3; ++tips) {
            const Points points = transformed(prism(sides, tips), random.rotation(), Vec3(2.0), random.inBox(10.0));
            const Polytope hull = expectGoodHull(points, "sides " + std::to_string(sides));
            const int faces = tips == 0 ? sides + 2 : tips == 1 ? sides + 1 : 2 * sides;
            EXPECT_EQ(hull.face_begin.size() - 1, static_cast<std::size_t>(faces));
            EXPECT_EQ(hull.vertices.size(), points.size());
        }
    }
}

TEST(Hull, OfCosphericalLatticePoints) {
    // All integer points at squared distance r2 from the origin: many exactly coplanar ones.
    for (const int r2 : {2, 3, 5, 9, 14, 41, 101, 314, 1001}) {
        Points points;
        for (const Vec3& point : grid(65, 65, 65)) {
            const Vec3 p = point - Vec3(32.0);
            if (glm::dot(p, p) == r2) {
                points.push_back(p);
            }
        }
        const Polytope hull = expectGoodHull(points, "r2 " + std::to_string(r2));
        EXPECT_EQ(hull.vertices.size(), points.size());
    }
}

TEST(Hull, MergesLatticesIntoTheirBox) {
    Random random(15);
    for (int i = 0; i < 20 * soak(); ++i) {
        Points points = grid(6, 5, 7);
        points.insert(points.end(), points.begin(), points.end()); // all twice
        const Quat rotation = i % 2 == 0 ? kNoRotation : random.rotation();
        const Vec3 offset = i % 3 == 0 ? random.inBox(1e6) : Vec3(0.0);
        const Polytope hull =
            expectGoodHull(transformed(points, rotation, Vec3(0.1, 0.3, 0.7), offset), "grid " + std::to_string(i));
        EXPECT_EQ(hull.vertices.size(), 8U);
        EXPECT_EQ(hull.face_begin.size(), 7U);
    }
    expectGoodHull(grid(40, 40, 40), "64000 points");
}

TEST(Hull, OfNoisyPlanes) {
    Random random(16);
    for (int i = 0; i < 60 * soak(); ++i) {
        const double noise = std::pow(10.0, -15.0 + 0.1 * (i % 61));
        Points points = grid(2, 2, 2);
        for (int j = 0; j < 400; ++j) {
            Vec3 point = Vec3(0.5) + random.inBox(0.5);
            point[random.below(3)] = random.below(2);
            points.push_back(point);
        }
        points = transformed(points, i % 2 == 0 ? kNoRotation : random.rotation(), Vec3(1.0), Vec3(0.0));
        for (Vec3& point : points) {
            point += random.inBox(noise);
        }
        const Polytope hull = expectGoodHull(points, "noise " + std::to_string(noise * 1e15) + "e-15");
        if (noise < 3e-13) {
            EXPECT_EQ(hull.vertices.size(), 8U);
            EXPECT_EQ(hull.face_begin.size(), 7U);
        }
    }
}

TEST(Hull, OfDuplicatesAndRuns) {
    Random random(17);
    for (int i = 0; i < 60 * soak(); ++i) {
        const Points corners = cloud(random, 4 + random.below(12), i % 3);
        Points points = corners;
        for (int j = 0; j < 500; ++j) {
            const Vec3& a = corners[static_cast<std::size_t>(random.below(static_cast<int>(corners.size())))];
            const Vec3& b = corners[static_cast<std::size_t>(random.below(static_cast<int>(corners.size())))];
            const double share = random.below(3) == 0 ? 0.0 : random.uniform(0.0, 1.0);
            points.push_back(a + (b - a) * share); // runs along edges and diagonals, up to rounding
            if (j % 50 == 0) {
                points.push_back(a + random.inBox(1e-16));
            }
        }
        const Polytope hull = expectGoodHull(points, "runs " + std::to_string(i));
        EXPECT_EQ(hull.vertices.size(), valueOf(convexHull(corners)).vertices.size());
    }
}

/// Any 4 to 8 points of a small lattice, bent by as little as a rounding: a solid with the properties, or an error.
TEST(Hull, OfFewDegeneratePoints) {
    Random random(18);
    int solids = 0;
    int refused = 0;
    for (int i = 0; i < 4000 * soak(); ++i) {
        Points points;
        const int count = 4 + random.below(5);
        const double noise = random.below(2) == 0 ? 0.0 : std::pow(10.0, random.uniform(-17.0, -8.0));
        const Vec3 offset = random.below(4) == 0 ? random.inBox(1e5) : Vec3(0.0);
        for (int j = 0; j < count; ++j) {
            points.push_back(offset + Vec3(random.below(3), random.below(3), random.below(3)) + random.inBox(noise));
        }
        auto hull = convexHull(points);
        if (!hull) {
            ++refused;
            EXPECT_FALSE(hull.error().message.empty());
            continue;
        }
        ++solids;
        SCOPED_TRACE("run " + std::to_string(i));
        expectHullOf(hull.value(), points, 2e-10 + 16.0 * kEpsilon * largestOf(points));
        EXPECT_GT(massCenterOf(hull.value()).volume, 0.0);
        if (HasFailure()) {
            break;
        }
    }
    EXPECT_GT(solids, 1000);
    EXPECT_GT(refused, 50);
}

TEST(Hull, SaysWhatFlatPointsSpan) {
    const auto messageOf = [](const Points& points) { return convexHull(points).error().message; };
    EXPECT_NE(messageOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).find("at least 4"), std::string::npos);
    EXPECT_NE(messageOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}).find("one plane"), std::string::npos);
    EXPECT_NE(messageOf({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}).find("one line"), std::string::npos);
    EXPECT_NE(messageOf({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}).find("1e-9"), std::string::npos);
    EXPECT_NE(
        messageOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, std::numeric_limits<double>::infinity()}}).find("finite"),
        std::string::npos);
    // Turned, so that the plane and the line hold up to rounding only; near the origin, and far from it.
    Random random(19);
    for (const double offset : {0.0, 1e3, 1e6, 1e8}) {
        for (int i = 0; i < 20; ++i) {
            const Quat rotation = random.rotation();
            const Vec3 by = random.inBox(offset);
            const Points plane = transformed(cloud(random, 100, 2), rotation, Vec3(1.0, 1.0, 0.0), by);
            EXPECT_NE(messageOf(plane).find("one plane"), std::string::npos) << messageOf(plane);
            const Points line = transformed(cloud(random, 100, 2), rotation, Vec3(1.0, 0.0, 0.0), by);
            EXPECT_NE(messageOf(line).find("one line"), std::string::npos) << messageOf(line);
        }
    }
}

TEST(Hull, OfTheSmallestAndTheLargest) {
    Random random(20);
    for (const double size : {1e-9, 1e-5, 1.0, 1e5, 0.99e9}) {
        const Points points = transformed(cloud(random, 100, 2), kNoRotation, Vec3(size), Vec3(0.0));
        expectGoodHull(points, "size " + std::to_string(size), Vertices::SameAsQhull);
    }
    // Coordinates that vanish beside the others, down to the smallest there are.
    Points points = grid(2, 2, 2);
    for (Vec3& point : points) {
        point += Vec3(random.below(2) * 1e-300, random.below(2) * 5e-324, random.below(2) * 1e-160);
    }
    EXPECT_EQ(expectGoodHull(points, "vanishing").vertices.size(), 8U);
}

TEST(Orient, IsExact) {
    // Steps of one unit in the last place about a plane that rounding cannot tell.
    const Vec3 a(12.0, 12.0, 12.0);
    const Vec3 b(24.0, 24.0, 24.0);
    const Vec3 c(3.0, -5.0, 7.0);
    for (int i = -20; i <= 20; ++i) {
        for (int j = -20; j <= 20; ++j) {
            const Vec3 p(0.5 + i * 0x1p-53, 0.5 + j * 0x1p-53, 0.5);
            // (b - a) x (c - a) is 12 (12, -4, -8) up to sign; the rest are integers times 2^-53.
            const int expected = 12 * i - 4 * j;
            const Vec3 cross = glm::cross(b - a, c - a);
            const double sign = cross.x > 0.0 ? 1.0 : -1.0;
            const double got = sign * orientExactly(a, b, c, p);
            EXPECT_EQ(got > 0.0, expected > 0) << i << ' ' << j;
            EXPECT_EQ(got < 0.0, expected < 0) << i << ' ' << j;
        }
    }
}

} // namespace
} // namespace elastoon
