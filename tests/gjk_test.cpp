// GJK's answers prove themselves: points of the bodies, as far apart as two planes between them.
#include "gjk.h"

#include "closest_support.h"

namespace elastoon {
namespace {

constexpr double kTolerance = 1e-12;
/// Nearly parallel and nearly touching, a turn by the rounding of a direction moves far ends.
constexpr double kNearlyParallel = 1e-8;

/// What a run of cases met.
struct Tally {
    int cases = 0, overlaps = 0, near = 0, flaws = 0;
};

void prove(const Bodies& pair, ClosestSeed& seed, double tolerance, Tally& tally) {
    const double size = sizeOf(pair.a, pair.b);
    const Closest closest = gjkClosest(pair.a, pair.b, seed);
    const std::string flaw = flawOf(closest, pair.a, pair.b, tolerance * size);
    ++tally.cases;
    tally.overlaps += closest.overlap ? 1 : 0;
    tally.near += !closest.overlap && closest.distance < 0.5 * size ? 1 : 0;
    tally.flaws += flaw.empty() ? 0 : 1;
    if (!flaw.empty() && tally.flaws < 4) {
        ADD_FAILURE() << "case " << tally.cases << ": " << flaw << ", distance " << closest.distance;
    }
}

/// Every answer proves itself, and overlaps and near misses are both common.
template <class Make>
void proveAll(double tolerance, std::uint64_t random_seed, Make&& make) {
    Random random(random_seed);
    Tally tally;
    for (int i = 0; i < 10000 * soak(); ++i) {
        ClosestSeed cold;
        prove(make(random), cold, tolerance, tally);
    }
    EXPECT_EQ(tally.flaws, 0) << "of " << tally.cases;
    EXPECT_GT(tally.overlaps, tally.cases / 5);
    EXPECT_GT(tally.near, 3 * tally.cases / 10);
}

TEST(Gjk, ProvesRandomPairs) {
    proveAll(kTolerance, 1, [](Random& r) { return randomPair(r, solids().all); });
}

TEST(Gjk, ProvesLatticePairs) {
    proveAll(kTolerance, 2, [](Random& r) { return latticePair(r, solids().all); });
}

TEST(Gjk, ProvesPairsOfUnequalSize) {
    proveAll(kTolerance, 3, [](Random& r) { return unequalPair(r, solids().all); });
}

TEST(Gjk, ProvesNearlyParallelPairs) {
    proveAll(kNearlyParallel, 8, [](Random& r) { return nearlyParallelPair(r, solids().all); });
}

TEST(Gjk, ProvesTurnedLatticePairs) {
    proveAll(kTolerance, 9, [](Random& r) { return turnedLatticePair(r, solids().all); });
}

TEST(Gjk, WarmStartsGiveTheSame) {
    Random random(4);
    Tally tally;
    for (int i = 0; i < 100 * soak(); ++i) {
        ClosestSeed warm;
        const Motion motion = anyMotion(random, solids().all);
        for (int frame = 0; frame < 100; ++frame) {
            const Bodies pair = motion.at(0.01 * frame);
            prove(pair, warm, kTolerance, tally);
            ClosestSeed cold;
            const Closest other = gjkClosest(pair.a, pair.b, cold);
            ClosestSeed same = warm;
            EXPECT_NEAR(gjkClosest(pair.a, pair.b, same).distance, other.distance, kTolerance * sizeOf(pair.a, pair.b));
        }
    }
    EXPECT_EQ(tally.flaws, 0) << "of " << tally.cases;
    EXPECT_GT(tally.overlaps, tally.cases / 5);
    EXPECT_GT(tally.near, tally.cases / 5);
}

std::uint32_t vertexAt(const PosedShape& body, const Vec3& place) {
    std::uint32_t best = 0;
    for (std::uint32_t i = 0; i < body.shape->vertices().size(); ++i) {
        const auto distance = [&](std::uint32_t v) {
            return glm::length(worldOf(body, body.shape->vertices()[v]) - place);
        };
        best = distance(i) < distance(best) ? i : best;
    }
    return best;
}

ClosestSeed anySeed(Random& random, const Bodies& pair) {
    const auto anyVertex = [&](const PosedShape& body) {
        return static_cast<std::uint32_t>(random.below(static_cast<int>(body.shape->vertices().size())));
    };
    ClosestSeed seed;
    seed.pair_count = static_cast<std::uint8_t>(1 + random.below(4));
    for (std::size_t k = 0; k < seed.pair_count; ++k) {
        seed.pairs_a[k] = anyVertex(pair.a);
        seed.pairs_b[k] = anyVertex(pair.b);
    }
    return seed;
}

/// Pairs that have nothing to do with the pose: the simplex may be flat there, or one point several times.
TEST(Gjk, NoSeedMisleads) {
    Random random(11);
    Tally tally;
    for (int i = 0; i < 10000 * soak(); ++i) {
        Bodies pair = turnedLatticePair(random, solids().small);
        ClosestSeed seed = anySeed(random, pair);
        if (i % 4 == 1) {
            // A small box amid a large one: three pairs that are nearly on a line, nearly through the origin.
            pair.a.shape = pair.b.shape = solids().small[0].get();
            pair.a.linear = latticeRotation(random.below(24));
            const Vec3 scale = random.uniform(1e-4, 1e-2) * scaleOf(anyStretch(random));
            pair.b.linear = pair.a.linear * Mat3(scale.x, 0, 0, 0, scale.y, 0, 0, 0, scale.z);
            pair.a.position = pair.b.position;
            const std::uint32_t k = seed.pairs_a[0];
            seed.pair_count = 3;
            seed.pairs_a = {k, 7 - k, 7 - k, 0};
            seed.pairs_b = {k, k, 7 - k, 0};
        }
        if (i % 4 == 0) {
            // Boxes in one place: three pairs on a line through the origin, but for rounding.
            pair.a.shape = pair.b.shape = solids().small[0].get();
            pair.b.linear = glm::mat3_cast(random.rotation());
            pair.a.linear = pair.b.linear * latticeRotation(random.below(24));
            pair.a.position = pair.b.position;
            const auto onB = [&](std::uint32_t vertex) {
                return vertexAt(pair.b, worldOf(pair.a, pair.a.shape->vertices()[vertex]));
            };
            seed.pair_count = 3;
            seed.pairs_a[1] = 7 - seed.pairs_a[0];
            seed.pairs_a[2] = seed.pairs_a[0];
            seed.pairs_b = {onB(seed.pairs_a[1]), onB(seed.pairs_a[0]), onB(seed.pairs_a[0]), 0};
        }
        prove(pair, seed, kTolerance, tally);
    }
    EXPECT_EQ(tally.flaws, 0) << "of " << tally.cases;
    EXPECT_GT(tally.overlaps, tally.cases / 5);
    EXPECT_GT(tally.near, tally.cases / 5);
}

/// The nearest points are on a diameter of the cap, and a third corner is nearer by less than the distance's rounding.
TEST(Gjk, TipOverTheMiddleOfACap) {
    Random random(12);
    Tally tally;
    const ShapePtr can = valueOf(Shape::cylinder(0.5, 1.0, 32));
    const ShapePtr cone = valueOf(Shape::cone(0.5, 1.0, 12));
    for (int i = 0; i < 2000 * soak(); ++i) {
        Bodies pair{posed(cone, random.rotation(), 1.0, Vec3(0.0)), posed(can, random.rotation(), 1.0, Vec3(0.0))};
        const Vec3 axis = pair.b.linear[0];
        const auto tip = static_cast<std::uint32_t>(cone->supportVertex({1, 0, 0}));
        const double height = std::pow(10.0, random.uniform(-5, -2));
        pair.a.linear = glm::mat3_cast(glm::angleAxis(random.uniform(-0.3, 0.3), pair.b.linear[1])) *
                        Mat3(-pair.b.linear[0], -pair.b.linear[1], pair.b.linear[2]);
        pair.a.position = axis * (0.5 + height) + random.inBox(1e-11) - pair.a.linear * cone->vertices()[tip];
        ClosestSeed cold;
        prove(pair, cold, kTolerance, tally);
    }
    EXPECT_EQ(tally.flaws, 0) << "of " << tally.cases;
    EXPECT_EQ(tally.near, tally.cases);
}

TEST(Gjk, FeaturesHoldThePoints) {
    const ShapePtr box = solids().small[0];
    const PosedShape floor = posed(box, kNoRotation, 1.0, {0.0, -0.5, 0.0});
    ClosestSeed seed;
    PosedShape above = posed(box, kNoRotation, 1.0, {0.125, 0.75, 0.25});
    const Closest flat = gjkClosest(above, floor, seed);
    EXPECT_DOUBLE_EQ(flat.distance, 0.25);
    EXPECT_EQ(flat.normal, Vec3(0.0, 1.0, 0.0));
    above = posed(box, kNoRotation, 1.0, {1.5, 1.5, 2.5});
    const Closest corner = gjkClosest(above, floor, seed);
    EXPECT_EQ(corner.feature_a.kind, Feature::Kind::Vertex);
    EXPECT_EQ(corner.feature_b.kind, Feature::Kind::Vertex);
    EXPECT_DOUBLE_EQ(corner.distance, std::sqrt(3.5));
}

/// The distance of the bodies with a moved along the line: 0 on overlap.
double distanceMoved(const Bodies& pair, const Vec3& shift) {
    PosedShape moved = pair.a;
    moved.position += shift;
    ClosestSeed cold;
    const Closest closest = gjkClosest(moved, pair.b, cold);
    return closest.overlap ? 0.0 : closest.distance;
}

/// By the overlap test alone, between a shift that overlaps and one that does not.
double bisected(const Bodies& pair, const Vec3& line, double inside, double apart) {
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (inside + apart);
        (distanceMoved(pair, middle * line) > 0.0 ? apart : inside) = middle;
    }
    return apart;
}

/// Least distance over all shifts: it is convex in the shift.
double leastDistance(const Bodies& pair, const Vec3& line, double reach) {
    double low = -reach;
    double high = reach;
    for (int i = 0; i < 100; ++i) {
        const double p = low + (high - low) / 3.0;
        const double q = high - (high - low) / 3.0;
        (distanceMoved(pair, p * line) < distanceMoved(pair, q * line) ? high : low) =
            distanceMoved(pair, p * line) < distanceMoved(pair, q * line) ? q : p;
    }
    return distanceMoved(pair, low * line);
}

/// The contact proves itself: the bodies touch, and a plane parts them that the line leaves. And bisection agrees.
template <class Make>
void contactAll(double tolerance, std::uint64_t random_seed, Make&& make) {
    Random random(random_seed);
    int met = 0, missed = 0, bisections = 0;
    for (int i = 0; i < 4000 * soak(); ++i) {
        const Bodies pair = make(random);
        const double size = sizeOf(pair.a, pair.b);
        const Vec3 line = random.below(4) == 0 ? latticeRotation(random.below(24))[0] : random.direction();
        const auto contact = contactAlongByDistance(pair.a, pair.b, line);
        if (!contact) {
            ++missed;
            if (i % 10 == 0) {
                const double reach = glm::length(pair.a.position - pair.b.position) + 4.0 * size;
                // By a hair smaller, so that one that just grazes the other is past it.
                Bodies smaller = pair;
                smaller.a.linear *= 1.0 - 1e-9;
                EXPECT_GT(leastDistance(smaller, line, reach), 0.0) << i;
            }
            continue;
        }
        ++met;
        PosedShape moved = pair.a;
        moved.position += contact->shift * line;
        const double slope = glm::dot(contact->normal, line);
        EXPECT_GT(slope, 0.0);
        EXPECT_NEAR(gapAcross(moved, pair.b, contact->normal), 0.0, tolerance * size) << i;
        EXPECT_LE(distanceMoved(pair, contact->shift * line), tolerance * size) << i;
        const double inside = contact->shift - 0.01 * size;
        if (i % 10 == 0 && distanceMoved(pair, inside * line) == 0.0) {
            ++bisections;
            EXPECT_NEAR(bisected(pair, line, inside, contact->shift + 0.01 * size / slope), contact->shift,
                        100.0 * tolerance * size / slope);
        }
    }
    EXPECT_GT(met, 1000);
    EXPECT_GT(missed, 500);
    EXPECT_GT(bisections, 50);
}

TEST(Gjk, ContactAlongRandomPairs) {
    contactAll(kTolerance, 5, [](Random& r) { return randomPair(r, solids().all); });
}

TEST(Gjk, ContactAlongLatticePairs) {
    contactAll(kTolerance, 6, [](Random& r) { return latticePair(r, solids().all); });
}

TEST(Gjk, ContactAlongNearlyParallelPairs) {
    contactAll(kNearlyParallel, 10, [](Random& r) { return nearlyParallelPair(r, solids().all); });
}

TEST(Gjk, ContactAlongPairsOfUnequalSize) {
    contactAll(kTolerance, 7, [](Random& r) { return unequalPair(r, solids().all); });
}

} // namespace
} // namespace elastoon
