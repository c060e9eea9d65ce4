// Many bodies of many shapes among planes and solids that stand, move and turn, watched by the program's oracle.
// ELASTOON_SOAK multiplies the worlds: at 50 they are a million body-steps.
#include "closest.h"
#include "closest_support.h"
#include "oracle.h"
#include "push.h"
#include "squeeze.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace elastoon {
namespace {

constexpr int kWorlds = 14;
/// One world in so many has the ball of 2306 vertices: the oracle's work goes with their square.
constexpr int kLargeEvery = 14;
constexpr int kBodies = 12;
constexpr int kSteps = 120;
constexpr double kStep = 1.0 / 60.0;
/// Between the solids of a world, m: too far to meet two at once, or within reach of each other.
constexpr double kApart = 60.0;
constexpr double kCrowded = 2.0;

struct Cast {
    std::vector<ShapePtr> bodies; ///< the last one in few worlds
    std::vector<ShapePtr> solids;
};

ShapePtr cloud(std::uint64_t random_seed, int count, const Vec3& half) {
    Random random(random_seed);
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
        points.push_back(half * random.inBox(1.0));
    }
    return valueOf(Shape::hull(points));
}

const Cast& cast() {
    static const Cast kCast{
        {valueOf(Shape::box({0.3, 1.0, 0.5})), valueOf(Shape::cylinder(0.5, 1.0, 32)),
         valueOf(Shape::cylinder(0.2, 1.5, 12)), valueOf(Shape::cone(0.5, 1.0, 12)), valueOf(Shape::sphere(0.5, 2)),
         valueOf(Shape::sphere(0.5, 4)), valueOf(Shape::sphere(0.5, 8)), cloud(1, 20, {0.6, 0.4, 0.5}),
         valueOf(Shape::box({1.0, 0.05, 1.0})), valueOf(Shape::box({1.5, 0.03, 0.03})),
         valueOf(Shape::capsule(0.25, 1.6, 8)), cloud(3, 60, {0.8, 0.5, 0.5}), valueOf(Shape::sphere(0.5, 24))},
        {valueOf(Shape::box({3.0, 1.0, 3.0})), valueOf(Shape::box({0.1, 3.0, 4.0})),
         valueOf(Shape::cylinder(0.7, 3.0, 16)), valueOf(Shape::cone(1.2, 1.5, 12)), valueOf(Shape::sphere(1.2, 2)),
         cloud(2, 12, {2.0, 1.5, 1.5}), valueOf(Shape::box({3.0, 0.2, 0.2}))}};
    return kCast;
}

/// The bodies of a world, one of each kind.
ShapePtr castFor(int world, int index) {
    const bool large = index == kBodies - 1 && world % kLargeEvery == kLargeEvery - 1;
    return cast().bodies[static_cast<std::size_t>(large ? kBodies : index)];
}

/// Furthest that a stretched body can reach from its centre.
double reachOf(const BodyDef& def) {
    const double stretch = std::max(def.style.max_stretch, 1.0);
    return def.shape->reachAlong() * stretch + def.shape->reachAcross();
}

/// Some stand, some move, some turn, some do both.
void setInMotion(Random& random, ObstacleDef& def, double speed, double rate) {
    def.velocity = random.below(2) == 0 ? random.inBox(speed) : Vec3(0.0);
    def.angular_velocity = random.below(3) == 0 ? random.inBox(rate) : Vec3(0.0);
}

SceneBody bodyAgainst(Random& random, int index, const ShapePtr& shape, const Vec3& obstacle, const Vec3& way,
                      double clear) {
    SceneBody body;
    body.name = "body" + std::to_string(index);
    body.def.shape = shape;
    body.def.style = anyStyle(random);
    body.def.rotation = random.rotation();
    body.def.position = obstacle + way * (clear + reachOf(body.def) + random.uniform(0.1, 1.0));
    body.def.velocity = -random.uniform(0.0, 4.0) * way + random.inBox(1.0);
    return body;
}

/// One plane at any angle that gravity, more or less, leads to.
Scene planeScene(Random& random, int world) {
    Scene scene;
    const Vec3 normal = random.direction();
    scene.gravity = -random.uniform(2.0, 10.0) * glm::normalize(normal + 0.7 * random.direction());
    SceneObstacle plane;
    plane.name = "plane";
    plane.def = ObstacleDef::plane(normal, random.uniform(-2.0, 2.0));
    const Vec3 foot = plane.def.position;
    setInMotion(random, plane.def, 0.5, 0.1);
    scene.obstacles.push_back(plane);
    for (int i = 0; i < kBodies; ++i) {
        const Vec3 aside = random.inBox(3.0);
        scene.bodies.push_back(
            bodyAgainst(random, i, castFor(world, i), foot + aside - normal * glm::dot(aside, normal), normal, 0.0));
    }
    return scene;
}

/// Moves bodies that would start inside an obstacle up until they are free.
void makeRoom(Scene& scene) {
    World world = valueOf(World::create({.gravity = scene.gravity, .parallel_for = {}}));
    for (const SceneObstacle& obstacle : scene.obstacles) {
        (void)valueOf(world.addObstacle(obstacle.def));
    }
    for (SceneBody& body : scene.bodies) {
        while (world.overlapOf(body.def)) {
            body.def.position.y += 0.5;
        }
    }
}

/// A solid for each body, which falls on it from any side that is not below. Crowded ones have a floor as well.
Scene solidScene(Random& random, int world, double spacing) {
    Scene scene;
    scene.gravity = {0.0, -random.uniform(1.0, 6.0), 0.0};
    for (int i = 0; i < kBodies; ++i) {
        SceneObstacle solid;
        solid.name = "solid" + std::to_string(i);
        solid.shape = 0;
        // The oracle compares all edges: the largest bodies meet boxes.
        const ShapePtr shape = castFor(world, i);
        const bool large = shape->vertices().size() > 200;
        solid.def.shape =
            large ? cast().solids[static_cast<std::size_t>(random.below(2))] : anyOf(random, cast().solids);
        const int row = i / 4;
        solid.def.position = {spacing * (i % 4), 0.0, spacing * row};
        solid.def.rotation = random.below(3) == 0 ? kNoRotation : random.rotation();
        setInMotion(random, solid.def, 0.5, 0.5);
        Vec3 way = random.direction();
        way.y = std::fabs(way.y) + 0.5;
        way = glm::normalize(way);
        scene.bodies.push_back(
            bodyAgainst(random, i, shape, solid.def.position, way, solid.def.shape->boundingRadius()));
        scene.obstacles.push_back(solid);
    }
    if (spacing < kApart) {
        SceneObstacle floor;
        floor.name = "floor";
        floor.def = ObstacleDef::plane({0, 1, 0}, -3.0);
        scene.obstacles.push_back(floor);
        makeRoom(scene);
    }
    return scene;
}

/// Distance of a body from a plane or a solid, by the library itself: only to count.
double distanceOf(const World& world, BodyId body, ObstacleId obstacle) {
    const Pose pose = world.pose(body);
    const PosedShape posed_body{world.shape(body).get(), linearOf(pose), pose.position};
    const MovingFrame& frame = world.frame(obstacle);
    const Vec3 origin = frame.originAt(world.time());
    const Quat turned = frame.orientationAt(world.time());
    if (!world.shape(obstacle)) {
        const Vec3 normal = turned * world.planeNormal(obstacle);
        return glm::dot(normal, pose.position - origin) - reachOf(posed_body, -normal);
    }
    ClosestSeed cold;
    const PosedShape solid{world.shape(obstacle).get(), glm::mat3_cast(turned), origin};
    const Closest closest = closestPoints(posed_body, solid, cold);
    return closest.overlap ? 0.0 : closest.distance;
}

struct Tally {
    long steps = 0, near = 0, impacts = 0, rests = 0;
    long bodies = 0, crushed = 0, jumping = 0;
    OracleReport worst;
};

void keepWorse(Worst& worst, const Worst& other, int world) {
    if (other.value > worst.value) {
        worst = other;
        worst.body = "world " + std::to_string(world) + ", " + other.body;
    }
}

/// What closes on the body leaves it no form that fits, or it was closed in from all sides and given up:
/// docs/contacts.md, Limits.
bool isCrushed(const World& world, BodyId body) {
    const Phase& phase = world.phase(body);
    return isPressed(phase, world.time()) && !squeezed(phase, *world.shape(body), world.time()).fits;
}
bool isSettledBy(const Event& event, const World& world) {
    const Phase& phase = world.phase(event.body);
    return event.type == EventType::Squeeze && phase.is<Rest>() && phase.clear_of.empty();
}

/// Whether the body, kept clear of others, is elsewhere at once within the last step: by more than a fiftieth of its
/// length within a hundred-thousandth of a second.
bool jumped(const World& world, BodyId body) {
    const Phase& phase = world.phase(body);
    const Shape& shape = *world.shape(body);
    if (phase.clear_of.empty()) {
        return false;
    }
    const auto at = [&](double t) { return poseAt(phase, shape, t).position; };
    constexpr int kParts = 4;
    const double most = 0.02 * shape.length();
    const double end = world.time();
    const double begin = std::max(end - kStep, phase.start);
    for (int i = 0; i < kParts; ++i) {
        double from = begin + (end - begin) * i / kParts;
        double to = begin + (end - begin) * (i + 1) / kParts;
        while (to - from > 1e-5 && glm::length(at(to) - at(from)) > most) {
            const double middle = 0.5 * (from + to);
            const bool later = glm::length(at(to) - at(middle)) > glm::length(at(middle) - at(from));
            (later ? from : to) = middle;
        }
        if (glm::length(at(to) - at(from)) > most) {
            return true;
        }
    }
    return false;
}

/// Leaves out the bodies that have no room left, and counts them, and those that jump; bodies do not act on each other.
void leaveOutCrushed(Scene& scene, Tally& tally) {
    StagedScene staged = valueOf(stage(scene));
    std::vector<bool> crushed(staged.bodies.size()), jumping(staged.bodies.size());
    for (int k = 0; k < kSteps; ++k) {
        staged.world.step(kStep);
        for (const Event& event : staged.world.events()) {
            const auto body = std::find(staged.bodies.begin(), staged.bodies.end(), event.body) - staged.bodies.begin();
            const auto i = static_cast<std::size_t>(body);
            crushed[i] = crushed[i] || isSettledBy(event, staged.world);
        }
        for (std::size_t i = 0; i < staged.bodies.size(); ++i) {
            crushed[i] = crushed[i] || isCrushed(staged.world, staged.bodies[i]);
            jumping[i] = jumping[i] || jumped(staged.world, staged.bodies[i]);
        }
    }
    tally.bodies += static_cast<long>(scene.bodies.size());
    for (std::size_t i = scene.bodies.size(); i-- > 0;) {
        tally.jumping += jumping[i] ? 1 : 0;
        if (crushed[i]) {
            scene.bodies.erase(scene.bodies.begin() + static_cast<std::ptrdiff_t>(i));
            ++tally.crushed;
        }
    }
}

void play(const Scene& scene, int index, Tally& tally) {
    StagedScene staged = valueOf(stage(scene));
    Timeline timeline;
    timeline.begin(staged.world);
    for (int k = 0; k < kSteps; ++k) {
        staged.world.step(kStep);
        timeline.capture(staged.world);
        for (const Event& event : staged.world.events()) {
            tally.impacts += event.type == EventType::Impact ? 1 : 0;
            tally.rests += event.type == EventType::Rest ? 1 : 0;
        }
        for (const BodyId body : staged.bodies) {
            double least = std::numeric_limits<double>::infinity();
            for (const ObstacleId obstacle : staged.obstacles) {
                least = std::min(least, distanceOf(staged.world, body, obstacle));
            }
            ++tally.steps;
            tally.near += least < 0.5 * staged.world.shape(body)->length() ? 1 : 0;
        }
    }
    const OracleReport report = inspect(scene, staged, timeline, 1.0 / kStep);
    keepWorse(tally.worst.depth, report.depth, index);
    keepWorse(tally.worst.solid_depth, report.solid_depth, index);
    keepWorse(tally.worst.gap, report.gap, index);
    keepWorse(tally.worst.volume_error, report.volume_error, index);
    keepWorse(tally.worst.jump, report.jump, index);
    tally.worst.not_finite += report.not_finite;
    tally.worst.poses += report.poses;
}

void expectWithin(const char* what, const Worst& worst, double most) {
    EXPECT_LE(worst.value, most) << what << ": " << worst.body << " on " << worst.other << " at " << worst.time << " s";
}

void expectBounds(const Tally& tally) {
    expectWithin("deepest in a plane", tally.worst.depth, OracleReport::kMostDepth);
    expectWithin("deepest in a solid", tally.worst.solid_depth, OracleReport::kMostSolidDepth);
    expectWithin("volume error", tally.worst.volume_error, OracleReport::kMostVolumeError);
    expectWithin("jump between phases", tally.worst.jump, OracleReport::kMostJump);
    EXPECT_EQ(tally.worst.not_finite, 0U);
    EXPECT_GT(tally.impacts, tally.steps / 200);
    if (soak() > 1) {
        std::printf("soak: %ld body-steps, %ld near, %ld impacts, %ld rests, %zu poses; deepest %.2g L in a plane, "
                    "%.2g L in a solid, gap %.2g L, volume %.2g, jump %.2g\n",
                    tally.steps, tally.near, tally.impacts, tally.rests, tally.worst.poses, tally.worst.depth.value,
                    tally.worst.solid_depth.value, tally.worst.gap.value, tally.worst.volume_error.value,
                    tally.worst.jump.value);
    }
}

TEST(Soak, AllShapesAmongAllObstaclesHoldTheirBounds) {
    Tally tally;
    const int worlds = kWorlds * soak();
    for (int i = 0; i < worlds; ++i) {
        Random random(1000 + static_cast<std::uint64_t>(i));
        play(i % 3 == 0 ? planeScene(random, i) : solidScene(random, i, kApart), i, tally);
    }
    expectBounds(tally);
    expectWithin("widest gap in contact", tally.worst.gap, OracleReport::kMostGap);
    EXPECT_GT(tally.near, 3 * tally.steps / 10);
    EXPECT_LT(tally.near, 7 * tally.steps / 10);
}

/// Slabs and needles between solids that cut each other: wedges, edges, corners of all kinds. Gaps are not judged: what
/// waits keeps a body off by a plane, which goes on where the solid ends (docs/contacts.md).
TEST(Soak, CrowdedSolidsHoldTheirBounds) {
    Tally tally;
    const int worlds = kWorlds * soak();
    for (int i = 0; i < worlds; ++i) {
        Random random(1000 + static_cast<std::uint64_t>(i));
        Scene scene = solidScene(random, 0, kCrowded);
        leaveOutCrushed(scene, tally);
        play(scene, i, tally);
    }
    expectBounds(tally);
    EXPECT_LE(tally.crushed, tally.bodies / 1000);
    EXPECT_LE(tally.jumping, tally.bodies / 250);
    if (soak() > 1) {
        std::printf("soak: %ld of %ld bodies crushed, %ld jumping\n", tally.crushed, tally.bodies, tally.jumping);
    }
}

} // namespace
} // namespace elastoon
