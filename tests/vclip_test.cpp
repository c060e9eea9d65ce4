// V-Clip against GJK, from every start, against brute force, and against its own proof. ELASTOON_SOAK multiplies cases.
#include "vclip.h"

#include "closest_support.h"
#include "gjk.h"

namespace elastoon {
namespace {

constexpr double kTolerance = 1e-9;

/// What a run of cases met.
struct Tally {
    int cases = 0, overlaps = 0, near = 0, disagreements = 0, flaws = 0;
    VclipCounts counts;
};

double distanceOf(const Closest& closest) {
    return closest.overlap ? 0.0 : closest.distance;
}

struct Seeds {
    ClosestSeed vclip, gjk;
};

void compare(const Bodies& pair, Seeds& seeds, Tally& tally) {
    const double size = sizeOf(pair.a, pair.b);
    const Closest closest = vclipClosest(pair.a, pair.b, seeds.vclip, &tally.counts);
    const Closest other = gjkClosest(pair.a, pair.b, seeds.gjk);
    const std::string flaw = flawOf(closest, pair.a, pair.b, kTolerance * size);
    const bool agree = std::fabs(distanceOf(closest) - distanceOf(other)) <= kTolerance * size;
    ++tally.cases;
    tally.overlaps += closest.overlap ? 1 : 0;
    tally.near += !closest.overlap && closest.distance < 0.5 * size ? 1 : 0;
    tally.flaws += flaw.empty() ? 0 : 1;
    tally.disagreements += agree ? 0 : 1;
    if ((!flaw.empty() && tally.flaws < 4) || (!agree && tally.disagreements < 4)) {
        ADD_FAILURE() << "case " << tally.cases << ": " << flaw << "; V-Clip " << distanceOf(closest) << ", GJK "
                      << distanceOf(other);
    }
}

/// No disagreement, no flaw, no more fallbacks than are known of; and the cases were worth it.
void judge(const char* name, const Tally& tally, int most_fallbacks) {
    EXPECT_EQ(tally.disagreements, 0);
    EXPECT_EQ(tally.flaws, 0);
    EXPECT_EQ(tally.counts.open, 0);
    EXPECT_LE(tally.counts.cycles + tally.counts.unproven, most_fallbacks);
    EXPECT_GT(tally.near, 3 * tally.cases / 10);
    EXPECT_LT(tally.near, 8 * tally.cases / 10);
    if (soak() > 1) {
        std::printf("%s: %d cases, %d overlap, %d near; %d disagree, %d flawed; %d steps, %d escapes, %d cycles, "
                    "%d unproven\n",
                    name, tally.cases, tally.overlaps, tally.near, tally.disagreements, tally.flaws, tally.counts.steps,
                    tally.counts.escapes, tally.counts.cycles, tally.counts.unproven);
    }
}

template <class Make>
void agreeOn(const char* name, double fallback_share, std::uint64_t random_seed, Make&& make) {
    Random random(random_seed);
    Tally tally;
    for (int i = 0; i < 15000 * soak(); ++i) {
        Seeds cold;
        compare(make(random), cold, tally);
    }
    judge(name, tally, static_cast<int>(fallback_share * tally.cases));
}

TEST(Vclip, AgreesOnRandomPairs) {
    agreeOn("random", 0.0, 1, [](Random& r) { return randomPair(r, solids().all); });
}

TEST(Vclip, AgreesOnLatticePairs) {
    agreeOn("lattice", 2e-4, 2, [](Random& r) { return latticePair(r, solids().all); });
}

TEST(Vclip, AgreesOnPairsOfUnequalSize) {
    agreeOn("unequal", 0.0, 3, [](Random& r) { return unequalPair(r, solids().all); });
}

TEST(Vclip, AgreesInMotionThroughContact) {
    Random random(4);
    Tally tally;
    for (int i = 0; i < 250 * soak(); ++i) {
        Seeds warm;
        const Motion motion = anyMotion(random, solids().all);
        for (int frame = 0; frame < 100; ++frame) {
            compare(motion.at(0.01 * frame), warm, tally);
        }
    }
    judge("motion", tally, 0);
    EXPECT_GT(tally.overlaps, tally.cases / 10);
    EXPECT_LT(tally.counts.steps, 5 * tally.cases);
}

TEST(Vclip, AgreesOnNearlyParallelPairs) {
    agreeOn("parallel", 2e-4, 5, [](Random& r) { return nearlyParallelPair(r, solids().all); });
}

TEST(Vclip, AgreesOnTurnedLatticePairs) {
    agreeOn("turned lattice", 0.01, 6, [](Random& r) { return turnedLatticePair(r, solids().all); });
}

std::vector<Feature> featuresOf(const Shape& shape) {
    std::vector<Feature> features;
    const auto add = [&](Feature::Kind kind, std::size_t count) {
        for (std::uint32_t i = 0; i < count; ++i) {
            features.push_back({kind, i});
        }
    };
    add(Feature::Kind::Vertex, shape.vertices().size());
    add(Feature::Kind::Edge, shape.topology().edges.size());
    add(Feature::Kind::Face, shape.faceCount());
    return features;
}

TEST(Vclip, EveryStartEndsTheSame) {
    Random random(7);
    VclipCounts counts;
    int starts = 0;
    int wrong = 0;
    for (int i = 0; i < 60 * soak(); ++i) {
        const Bodies pair = i % 2 == 0 ? latticePair(random, solids().small) : randomPair(random, solids().small);
        const double size = sizeOf(pair.a, pair.b);
        ClosestSeed cold;
        const double distance = distanceOf(gjkClosest(pair.a, pair.b, cold));
        for (const Feature& a : featuresOf(*pair.a.shape)) {
            for (const Feature& b : featuresOf(*pair.b.shape)) {
                ClosestSeed seed;
                seed.has_features = true;
                seed.a = a;
                seed.b = b;
                ++starts;
                const Closest closest = vclipClosest(pair.a, pair.b, seed, &counts);
                wrong += std::fabs(distanceOf(closest) - distance) <= kTolerance * size ? 0 : 1;
            }
        }
    }
    EXPECT_EQ(wrong, 0) << "of " << starts;
    EXPECT_LE(counts.cycles + counts.unproven, starts / 500);
    if (soak() > 1) {
        std::printf("starts: %d, %d wrong; %d escapes, %d cycles, %d unproven\n", starts, wrong, counts.escapes,
                    counts.cycles, counts.unproven);
    }
}

/// Widest gap over all axes that can part two polytopes; negative on overlap.
double widestGap(const PosedShape& a, const PosedShape& b) {
    double widest = -std::numeric_limits<double>::infinity();
    for (std::size_t face = 0; face < a.shape->faceCount(); ++face) {
        widest = std::max(widest, gapAcross(a, b, -faceNormal(a, face)));
    }
    for (std::size_t face = 0; face < b.shape->faceCount(); ++face) {
        widest = std::max(widest, gapAcross(a, b, faceNormal(b, face)));
    }
    for (const Topology::Edge& p : a.shape->topology().edges) {
        for (const Topology::Edge& q : b.shape->topology().edges) {
            const Vec3 u = a.linear * (a.shape->vertices()[p.head] - a.shape->vertices()[p.tail]);
            const Vec3 v = b.linear * (b.shape->vertices()[q.head] - b.shape->vertices()[q.tail]);
            const Vec3 across = glm::cross(u, v);
            const double length = glm::length(across);
            if (length > 1e-9 * glm::length(u) * glm::length(v)) {
                widest = std::max({widest, gapAcross(a, b, across / length), gapAcross(a, b, -across / length)});
            }
        }
    }
    return widest;
}

double toSegment(const Vec3& point, const Vec3& from, const Vec3& to) {
    const Vec3 along = to - from;
    const double part = std::clamp(glm::dot(point - from, along) / glm::dot(along, along), 0.0, 1.0);
    return glm::length(point - (from + part * along));
}

/// Least distance of two segments: of an end, or where their common perpendicular meets both.
double ofSegments(const Vec3& p, const Vec3& p2, const Vec3& q, const Vec3& q2) {
    const double ends =
        std::min({toSegment(p, q, q2), toSegment(p2, q, q2), toSegment(q, p, p2), toSegment(q2, p, p2)});
    const Vec3 across = glm::cross(p2 - p, q2 - q);
    const double squared = glm::dot(across, across);
    if (!(squared > 0.0)) {
        return ends;
    }
    const double s = glm::dot(glm::cross(q - p, q2 - q), across) / squared;
    const double t = glm::dot(glm::cross(q - p, p2 - p), across) / squared;
    const bool within = s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0;
    return within ? std::min(ends, std::fabs(glm::dot(q - p, across)) / std::sqrt(squared)) : ends;
}

double ofVerticesToFaces(const PosedShape& a, const PosedShape& b) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t face = 0; face < b.shape->faceCount(); ++face) {
        const Vec3 normal = faceNormal(b, face);
        const auto loop = b.shape->face(face);
        for (const Vec3& vertex : a.shape->vertices()) {
            const Vec3 point = worldOf(a, vertex);
            bool above = true;
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const Vec3 from = worldOf(b, b.shape->vertices()[loop[i]]);
                const Vec3 to = worldOf(b, b.shape->vertices()[loop[(i + 1) % loop.size()]]);
                above = above && glm::dot(glm::cross(normal, to - from), point - from) >= 0.0;
            }
            const double height = glm::dot(normal, point - worldOf(b, b.shape->vertices()[loop[0]]));
            least = above && height > 0.0 ? std::min(least, height) : least;
        }
    }
    return least;
}

double bruteDistance(const PosedShape& a, const PosedShape& b) {
    if (widestGap(a, b) <= 1e-13 * sizeOf(a, b)) {
        return 0.0;
    }
    double least = std::min(ofVerticesToFaces(a, b), ofVerticesToFaces(b, a));
    for (const Topology::Edge& p : a.shape->topology().edges) {
        for (const Topology::Edge& q : b.shape->topology().edges) {
            const auto of_a = a.shape->vertices();
            const auto of_b = b.shape->vertices();
            least = std::min(least, ofSegments(worldOf(a, of_a[p.tail]), worldOf(a, of_a[p.head]),
                                               worldOf(b, of_b[q.tail]), worldOf(b, of_b[q.head])));
        }
    }
    return least;
}

TEST(Vclip, AgreesWithBruteForce) {
    Random random(8);
    int near = 0;
    const int cases = 1500 * soak();
    for (int i = 0; i < cases; ++i) {
        const Bodies pair = i % 2 == 0 ? latticePair(random, solids().small) : randomPair(random, solids().small);
        const double size = sizeOf(pair.a, pair.b);
        const double distance = bruteDistance(pair.a, pair.b);
        ClosestSeed seed;
        EXPECT_NEAR(distanceOf(vclipClosest(pair.a, pair.b, seed)), distance, kTolerance * size) << i;
        ClosestSeed gjk_seed;
        EXPECT_NEAR(distanceOf(gjkClosest(pair.a, pair.b, gjk_seed)), distance, kTolerance * size) << i;
        near += distance > 0.0 && distance < 0.5 * size ? 1 : 0;
    }
    EXPECT_GT(near, 3 * cases / 10);
    EXPECT_LT(near, 7 * cases / 10);
}

/// A solid given with points on its faces and edges besides is the same solid.
TEST(Vclip, TwinsWithMorePointsAreTheSame) {
    Random random(9);
    for (int i = 0; i < 300 * soak(); ++i) {
        const ShapePtr shape = anyOf(random, solids().all);
        std::vector<Vec3> points(shape->vertices().begin(), shape->vertices().end());
        for (std::size_t face = 0; face < shape->faceCount(); ++face) {
            const auto loop = shape->face(face);
            const Vec3 p = shape->vertices()[loop[0]];
            const Vec3 q = shape->vertices()[loop[1]];
            points.push_back(0.5 * (p + q));
            points.push_back((p + q + shape->vertices()[loop[2]]) / 3.0);
        }
        const ShapePtr twin = valueOf(Shape::hull(points));
        EXPECT_TRUE(twin->topology().closed);
        Bodies pair = i % 2 == 0 ? latticePair(random, solids().all) : randomPair(random, solids().all);
        const PosedShape place = pair.a;
        pair.a.shape = shape.get();
        Bodies other = pair;
        other.a.shape = twin.get();
        other.a.position = place.position + place.linear * twin->centroidOfInput();
        ClosestSeed seed;
        ClosestSeed twin_seed;
        EXPECT_NEAR(distanceOf(vclipClosest(pair.a, pair.b, seed)),
                    distanceOf(vclipClosest(other.a, other.b, twin_seed)), kTolerance * sizeOf(pair.a, pair.b));
    }
}

TEST(Vclip, KeepsTheLastDisjointFeaturesThroughContact) {
    const ShapePtr box = solids().small[0];
    const PosedShape floor = posed(box, kNoRotation, 1.0, Vec3(0.0));
    ClosestSeed seed;
    EXPECT_FALSE(vclipClosest(posed(box, kNoRotation, 1.0, {0.1, 1.5, 0.2}), floor, seed).overlap);
    const ClosestSeed before = seed;
    EXPECT_TRUE(vclipClosest(posed(box, kNoRotation, 1.0, {0.1, 0.5, 0.2}), floor, seed).overlap);
    EXPECT_TRUE(seed.has_features);
    EXPECT_EQ(seed.a, before.a);
    EXPECT_EQ(seed.b, before.b);
}

/// At 1e-13 of the size a difference of points has no direction left; the normal still parts the bodies.
TEST(Vclip, NormalsHoldAtVanishingDistances) {
    Random random(10);
    int near = 0;
    for (int i = 0; i < 3000 * soak(); ++i) {
        Bodies pair = randomPair(random, solids().small);
        const double size = sizeOf(pair.a, pair.b);
        const Vec3 line = random.direction();
        const auto contact = contactAlong(pair.a, pair.b, line);
        if (!contact || glm::dot(contact->normal, line) < 0.1) {
            continue;
        }
        pair.a.position += (contact->shift + size * std::pow(10.0, random.uniform(-14, -10))) * line;
        for (const ClosestMethod method : {ClosestMethod::Vclip, ClosestMethod::Gjk}) {
            ClosestSeed seed;
            const Closest closest = closestPoints(pair.a, pair.b, seed, method);
            if (!closest.overlap) {
                ++near;
                EXPECT_LT(closest.distance, 1e-9 * size);
                EXPECT_GT(gapAcross(pair.a, pair.b, closest.normal), -1e-13 * size) << i;
            }
        }
    }
    EXPECT_GT(near, 1000);
}

} // namespace
} // namespace elastoon
