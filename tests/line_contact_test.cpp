// Contact along a line: the portal against Newton's method on the distance, against all planes of the difference, and
// in closed form. What the portal leaves to the other method is counted.
#include "line_contact.h"

#include "closest_support.h"
#include "gjk.h"

namespace elastoon {
namespace {

constexpr double kTolerance = 1e-13;

struct LineTally {
    int cases = 0, touches = 0, misses = 0, unsure = 0;
};

struct LineCase {
    Bodies pair;
    Vec3 line{0.0, 1.0, 0.0};
};

double distanceAt(const Bodies& pair, const Vec3& shift) {
    PosedShape moved = pair.a;
    moved.position += shift;
    ClosestSeed cold;
    const Closest closest = closestPoints(moved, pair.b, cold);
    return closest.overlap ? 0.0 : closest.distance;
}

/// A plane parts the bodies that the line leaves; there or a hair back they touch, a hair further they do not.
void proveContact(const LineCase& c, const LineContact& contact, double size, double tolerance) {
    const double sine = glm::dot(contact.normal, c.line);
    EXPECT_GT(sine, 0.0);
    EXPECT_NEAR(glm::length(contact.normal), 1.0, 1e-14);
    PosedShape moved = c.pair.a;
    moved.position += contact.shift * c.line;
    EXPECT_NEAR(gapAcross(moved, c.pair.b, contact.normal), 0.0, kTolerance * size);
    const double hair = kTolerance * size / sine;
    // Where the line cuts a corner off, shorter than that, a hair back is on the other side.
    EXPECT_LE(std::min(distanceAt(c.pair, contact.shift * c.line), distanceAt(c.pair, (contact.shift - hair) * c.line)),
              tolerance * size);
    EXPECT_GT(distanceAt(c.pair, (contact.shift + 2.0 * hair) * c.line), 0.0);
}

void check(const LineCase& c, double tolerance, LineTally& tally) {
    const double size = sizeOf(c.pair.a, c.pair.b) + 1e-2 * glm::length(c.pair.a.position - c.pair.b.position);
    LineContact contact;
    const PortalEnd end = contactByPortal(c.pair.a, c.pair.b, c.line, contact);
    const auto oracle = contactAlongByDistance(c.pair.a, c.pair.b, c.line);
    ++tally.cases;
    tally.touches += end == PortalEnd::Touches ? 1 : 0;
    tally.misses += end == PortalEnd::Misses ? 1 : 0;
    tally.unsure += end == PortalEnd::Unsure ? 1 : 0;
    const auto whole = contactAlong(c.pair.a, c.pair.b, c.line);
    EXPECT_EQ(separationAlong(c.pair.a, c.pair.b, c.line), whole ? std::optional(whole->shift) : std::nullopt);
    if (end == PortalEnd::Unsure) {
        EXPECT_EQ(whole.has_value(), oracle.has_value());
        return;
    }
    ASSERT_EQ(oracle.has_value(), end == PortalEnd::Touches) << "case " << tally.cases;
    ASSERT_EQ(whole.has_value(), end == PortalEnd::Touches);
    if (end == PortalEnd::Touches) {
        EXPECT_EQ(whole->shift, contact.shift);
        proveContact(c, contact, size, tolerance);
        const double sine = std::min(glm::dot(contact.normal, c.line), glm::dot(oracle->normal, c.line));
        EXPECT_NEAR(contact.shift, oracle->shift, tolerance * size / sine) << "case " << tally.cases;
    }
}

/// `most_unsure`: in a thousand.
template <class Make>
void checkAll(std::uint64_t random_seed, double tolerance, double most_unsure, Make&& make) {
    Random random(random_seed);
    LineTally tally;
    for (int i = 0; i < 5000 * soak() && !testing::Test::HasFailure(); ++i) {
        check(make(random), tolerance, tally);
    }
    EXPECT_LE(tally.unsure, most_unsure * 1e-3 * tally.cases);
    EXPECT_GT(tally.touches, tally.cases / 5);
}

template <class MakePair>
auto withAnyLine(MakePair&& make) {
    return [make](Random& r) { return LineCase{make(r, solids().all), r.direction()}; };
}

template <class MakePair>
auto withLatticeLine(MakePair&& make) {
    return [make](Random& r) { return LineCase{make(r, solids().all), latticeRotation(r.below(24))[0]}; };
}

TEST(LineContact, RandomPairs) {
    checkAll(1, kTolerance, 1.0, withAnyLine(randomPair));
}

TEST(LineContact, LatticePairs) {
    checkAll(2, kTolerance, 1.0, withAnyLine(latticePair));
}

TEST(LineContact, LatticePairsOnLatticeLines) {
    checkAll(3, kTolerance, 1000.0, withLatticeLine(latticePair));
}

TEST(LineContact, TurnedLatticePairs) {
    checkAll(4, kTolerance, 1.0, withAnyLine(turnedLatticePair));
}

TEST(LineContact, NearlyParallelPairs) {
    checkAll(5, 1e-8, 1.0, withAnyLine(nearlyParallelPair));
}

TEST(LineContact, NearlyParallelPairsOnLatticeLines) {
    checkAll(6, 1e-8, 1000.0, withLatticeLine(nearlyParallelPair));
}

TEST(LineContact, PairsOfUnequalSize) {
    checkAll(7, kTolerance, 1.0, withAnyLine(unequalPair));
}

/// A deformed body above the edges and corners of a solid, along the normal of the solid's face: what impacts ask.
TEST(LineContact, BodiesOverEdgesAndCorners) {
    const ShapePtr solid = valueOf(Shape::box({3.0, 0.8, 3.0}));
    checkAll(8, kTolerance, 1.0, [&](Random& r) {
        LineCase c{{posed(anyOf(r, solids().all), r.rotation(), anyStretch(r), Vec3(0.0)),
                    {solid.get(), Mat3(1.0), Vec3(0.0)}}};
        const double beyond = 0.5 * reachOf(c.pair.a, {-1.0, 0.0, 0.0});
        const bool corner = r.below(3) == 0;
        c.pair.a.position = {1.5 + r.uniform(-0.1, beyond), r.uniform(0.0, 2.0),
                             corner ? 1.5 + r.uniform(-0.1, 0.1) : r.uniform(-1.5, 1.5)};
        return c;
    });
}

/// The line leaves the difference by a vertex, an edge, or a diagonal of a face, to within rounding or a hair more.
TEST(LineContact, LinesThroughVerticesAndEdges) {
    checkAll(9, kTolerance, 10.0, [](Random& r) {
        LineCase c{randomPair(r, solids().all)};
        const PosedShape& a = c.pair.a;
        const PosedShape& b = c.pair.b;
        const auto corner = [](const PosedShape& body, std::size_t vertex) {
            return body.linear * body.shape->vertices()[vertex];
        };
        const auto support = [&](const PosedShape& body, const Vec3& direction) {
            return corner(body, body.shape->supportVertex(direction * body.linear));
        };
        // A face of b and the vertex of a that lies against it.
        const auto face = static_cast<std::size_t>(r.below(static_cast<int>(b.shape->faceCount())));
        const Vec3 normal = faceNormal(b, face);
        const auto loop = b.shape->face(face);
        const std::array<double, 3> weights{0.0, 0.25, 0.5};
        const double weight = weights[static_cast<std::size_t>(r.below(3))];
        const std::size_t other = r.below(2) == 0 ? 1 : loop.size() / 2;
        const Vec3 exit = support(a, -normal) - ((1.0 - weight) * corner(b, loop[0]) + weight * corner(b, loop[other]));
        const Vec3 other_way = r.direction();
        const Vec3 inside = 0.4 * (support(a, other_way) - support(b, -other_way));
        // The difference leaves by the way from the inside; a moves against it.
        c.line = glm::normalize(inside - exit);
        c.pair.a.position = b.position - exit + r.uniform(-3.0, 3.0) * c.line;
        if (r.below(2) == 0) {
            c.pair.a.position += r.direction() * std::pow(10.0, r.uniform(-16.0, -6.0));
        }
        return c;
    });
}

TEST(LineContact, FlatSlabsAndNeedles) {
    checkAll(10, kTolerance, 5.0, [](Random& r) {
        const auto thin = [&](const ShapePtr& shape) {
            PosedShape body = posed(shape, r.rotation(), 1.0, r.inBox(0.2));
            const double flat = r.below(2) == 0 ? 0.05 : 1e-3;
            body.linear = body.linear * (r.below(2) == 0 ? Mat3(1, 0, 0, 0, flat, 0, 0, 0, 1)
                                                         : Mat3(1, 0, 0, 0, flat, 0, 0, 0, flat));
            return body;
        };
        return LineCase{{thin(anyOf(r, solids().all)), thin(anyOf(r, solids().all))}, r.direction()};
    });
}

TEST(LineContact, FarAwayAlongTheLine) {
    checkAll(11, kTolerance, 1.0, [](Random& r) {
        LineCase c{randomPair(r, solids().all), r.direction()};
        c.pair.a.position = c.pair.b.position + r.inBox(0.3) + r.uniform(-1e4, 1e4) * c.line;
        return c;
    });
}

TEST(LineContact, TheSameShapeTwice) {
    checkAll(12, kTolerance, 5.0, [](Random& r) {
        LineCase c{randomPair(r, solids().all), r.direction()};
        c.pair.a = c.pair.b;
        c.pair.a.position += r.below(2) == 0 ? Vec3(0.0) : r.uniform(-1.0, 1.0) * c.line;
        return c;
    });
}

/// Normals of all planes that can bound the difference of the bodies.
std::vector<Vec3> allNormals(const Bodies& pair) {
    std::vector<Vec3> normals;
    const auto edgesOf = [](const PosedShape& body) {
        std::vector<Vec3> edges;
        for (const Topology::Edge& edge : body.shape->topology().edges) {
            edges.push_back(body.linear * (body.shape->vertices()[edge.head] - body.shape->vertices()[edge.tail]));
        }
        return edges;
    };
    for (std::size_t face = 0; face < pair.a.shape->faceCount(); ++face) {
        normals.push_back(-faceNormal(pair.a, face));
    }
    for (std::size_t face = 0; face < pair.b.shape->faceCount(); ++face) {
        normals.push_back(faceNormal(pair.b, face));
    }
    for (const Vec3& p : edgesOf(pair.a)) {
        for (const Vec3& q : edgesOf(pair.b)) {
            const Vec3 normal = glm::cross(p, q);
            const double length = glm::length(normal);
            if (length > 1e-6 * glm::length(p) * glm::length(q)) {
                normals.push_back(normal / length);
                normals.push_back(-normal / length);
            }
        }
    }
    return normals;
}

/// What every plane leaves of the line: the shifts from `least` to `greatest`, none where that is less.
struct Clipped {
    double least = -1e300, greatest = 1e300;
};

Clipped clippedByPlanes(const Bodies& pair, const Vec3& line) {
    Clipped clipped;
    for (const Vec3& normal : allNormals(pair)) {
        // Moved by t, the bodies overlap while the gap across every plane is negative.
        const double gap = gapAcross(pair.a, pair.b, normal);
        const double slope = glm::dot(normal, line);
        if (slope > 1e-9) {
            clipped.greatest = std::min(clipped.greatest, -gap / slope);
        } else if (slope < -1e-9) {
            clipped.least = std::max(clipped.least, -gap / slope);
        }
    }
    return clipped;
}

TEST(LineContact, AgreesWithAllPlanesOfTheDifference) {
    Random random(13);
    int touches = 0, misses = 0, grazes = 0;
    for (int i = 0; i < 3000 * soak(); ++i) {
        const Bodies pair = i % 2 == 0 ? randomPair(random, solids().small) : turnedLatticePair(random, solids().small);
        const Vec3 line = random.direction();
        const Clipped clipped = clippedByPlanes(pair, line);
        const auto contact = contactAlong(pair.a, pair.b, line);
        if (std::fabs(clipped.greatest - clipped.least) < 1e-9) {
            ++grazes;
            continue;
        }
        ASSERT_EQ(contact.has_value(), clipped.least < clipped.greatest) << i;
        ++(contact ? touches : misses);
        if (contact) {
            const double sine = glm::dot(contact->normal, line);
            EXPECT_NEAR(contact->shift, clipped.greatest, kTolerance * sizeOf(pair.a, pair.b) / sine) << i;
        }
    }
    EXPECT_GT(touches, 1000 * soak());
    EXPECT_GT(misses, 300 * soak());
    EXPECT_LT(grazes, 10 * soak());
}

TEST(LineContact, ClosedForms) {
    const ShapePtr cube = valueOf(Shape::box({1, 1, 1}));
    const PosedShape floor = posed(cube, kNoRotation, 1.0, {0.0, -0.5, 0.0});
    const Vec3 up(0.0, 1.0, 0.0);
    const Quat eighth = glm::angleAxis(0.25 * 3.14159265358979323846, Vec3(0.0, 0.0, 1.0));
    LineContact contact;
    // Face on face.
    ASSERT_EQ(contactByPortal(posed(cube, kNoRotation, 1.0, {0.125, 0.75, 0.25}), floor, up, contact),
              PortalEnd::Touches);
    EXPECT_EQ(contact.shift, -0.25);
    EXPECT_EQ(contact.normal, up);
    // Edge on face.
    ASSERT_EQ(contactByPortal(posed(cube, eighth, 1.0, {0.125, 0.25, 0.125}), floor, up, contact), PortalEnd::Touches);
    EXPECT_NEAR(contact.shift, std::sqrt(0.5) - 0.25, 1e-15);
    // A slanting face on an edge: the edge is at x = 0.5, and the face rises by as much as it goes out.
    ASSERT_EQ(contactByPortal(posed(cube, eighth, 1.0, {0.75, 0.25, 0.0}), floor, up, contact), PortalEnd::Touches);
    EXPECT_NEAR(contact.shift, std::sqrt(0.5) - 0.5, 1e-15);
    EXPECT_NEAR(glm::length(contact.normal - glm::normalize(Vec3(1.0, 1.0, 0.0))), 0.0, 1e-15);
    // Edge across edge, both upright in the difference: a diamond turned by a quarter over another.
    const PosedShape roof = posed(cube, eighth, 1.0, Vec3(0.0));
    PosedShape across = posed(cube, glm::angleAxis(0.5 * 3.14159265358979323846, up) * eighth, 1.0, {0.1, 3.0, 0.2});
    ASSERT_EQ(contactByPortal(across, roof, up, contact), PortalEnd::Touches);
    EXPECT_NEAR(contact.shift, 2.0 * std::sqrt(0.5) - 3.0, 2e-15);
    EXPECT_NEAR(glm::length(contact.normal - up), 0.0, 1e-15);
    // Past it.
    across.position = {1.3, 3.0, 0.2};
    EXPECT_EQ(contactByPortal(across, roof, up, contact), PortalEnd::Misses);
    // A vertex on a face: a cone's tip.
    const ShapePtr cone = valueOf(Shape::cone(0.5, 1.0, 32));
    const Quat down = glm::angleAxis(-0.5 * 3.14159265358979323846, Vec3(0.0, 0.0, 1.0));
    ASSERT_EQ(contactByPortal(posed(cone, down, 1.0, {0.2, 1.0, -0.3}), floor, up, contact), PortalEnd::Touches);
    EXPECT_NEAR(contact.shift, -0.25, 1e-15);
    EXPECT_NEAR(glm::length(contact.normal - up), 0.0, 1e-14);
}

/// Along a side that the line runs in either answer will do; where they are said to touch, they do.
TEST(LineContact, GrazingLines) {
    const ShapePtr cube = valueOf(Shape::box({1, 1, 1}));
    const ShapePtr ball = valueOf(Shape::sphere(0.5, 8));
    int unsure = 0;
    for (const ShapePtr& shape : {cube, ball}) {
        for (const double z : {0.0, 0.25, 0.625}) {
            const LineCase c{{posed(shape, kNoRotation, 1.0, {1.0, 3.0, z}), posed(cube, kNoRotation, 1.0, Vec3(0.0))}};
            LineContact contact;
            unsure += contactByPortal(c.pair.a, c.pair.b, c.line, contact) == PortalEnd::Unsure ? 1 : 0;
            if (const auto whole = contactAlong(c.pair.a, c.pair.b, c.line)) {
                EXPECT_LE(distanceAt(c.pair, whole->shift * c.line), 1e-15);
            }
            // By a hair further off they miss, nearer they touch.
            for (const double hair : {-1e-9, 1e-9}) {
                LineCase near = c;
                near.pair.a.position.x += hair;
                const bool touches = hair < 0.0 && (shape == cube || z <= 0.5);
                EXPECT_EQ(contactAlong(near.pair.a, near.pair.b, c.line).has_value(), touches) << z << ' ' << hair;
            }
        }
    }
    EXPECT_GT(unsure, 0);
}

} // namespace
} // namespace elastoon
