// World::matrices() against pose(), to the bit, in worlds where everything happens and bodies come and go.
#include "dmath.h"
#include "elastoon/scene.h"
#include "flight.h"
#include "flight_lanes.h"
#include "golden/golden_run.h"
#include "impact_lanes.h"
#include "test_support.h"

namespace elastoon {
namespace {

/// How many floats differ from those that pose() gives.
int differences(World& world) {
    const std::span<const float> matrices = world.matrices();
    std::vector<float> expected(matrices.size(), 0.0F);
    for (const BodyId id : world.bodies()) {
        const Pose pose = world.pose(id);
        const Mat3 linear = linearOf(pose);
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 3; ++row) {
                const double value = column < 3 ? linear[column][row] : pose.position[row];
                const auto place = 12 * (std::ptrdiff_t{id.slot} - 1) + 3 * column + row;
                expected.at(static_cast<std::size_t>(place)) = static_cast<float>(value);
            }
        }
    }
    int count = 0;
    for (std::size_t i = 0; i < matrices.size(); ++i) {
        count += matrices[i] == expected[i] ? 0 : 1;
    }
    return count;
}

TEST(MatrixTable, IsWhatThePosesSayInAllGoldenScenes) {
    const std::string source = ELASTOON_SOURCE_DIR;
    for (const Golden& golden : valueOf(readGoldens(source + "/tests/golden/hashes.txt"))) {
        StagedScene staged = valueOf(stage(valueOf(readScene(source + "/scenes/" + golden.scene))));
        for (int k = 0; k < 240; ++k) {
            staged.world.step(1.0 / golden.fps);
            ASSERT_EQ(differences(staged.world), 0) << golden.scene << ", step " << k;
        }
    }
}

BodyDef thrown(Random& random) {
    BodyDef def;
    def.shape = valueOf(Shape::box({0.3, 0.5, 0.4}));
    def.style.restitution = random.uniform(0.0, 1.0);
    def.position = {random.uniform(-20.0, 20.0), random.uniform(1.0, 8.0), random.uniform(-20.0, 20.0)};
    // Straight up, standing still, and any way.
    const int kind = random.below(4);
    def.velocity = kind == 0   ? Vec3(0.0, 5.0, 0.0)
                   : kind == 1 ? Vec3(0.0)
                   : kind == 2 ? Vec3(0.01, 6.0, 0.0)
                               : random.inBox(8.0);
    def.rotation = random.rotation();
    return def;
}

/// An impact on a plane or on a solid, of any form: also with a half that takes no time.
Phase anyImpact(Random& random, const ShapePtr& solid) {
    Impact impact;
    impact.surface.solid = random.below(2) == 0 ? solid : nullptr;
    impact.begun = random.uniform(0.0, 100.0);
    MovingFrame& frame = impact.surface.frame;
    frame.origin = random.inBox(5.0);
    frame.orientation = random.below(2) == 0 ? kNoRotation : random.rotation();
    // The top of a solid within its border, where it ends, and what is no face of it.
    const bool on_top = impact.surface.solid != nullptr && random.below(3) != 0;
    impact.surface.point = on_top ? Vec3(random.uniform(-0.9, 0.9), 0.4, random.uniform(-0.9, 0.9)) : random.inBox(5.0);
    impact.surface.normal = on_top ? Vec3(0.0, 1.0, 0.0) : random.direction();
    impact.contact_in_shape = random.inBox(0.5);
    impact.orientation = random.rotation();
    impact.turn_axis = random.direction();
    impact.turn_angle = random.below(4) == 0 ? 0.0 : random.uniform(0.0, kPi);
    impact.skims = random.below(2) == 0 ? Vec3(0.0) : random.inBox(3.0);
    impact.easing = random.below(2) == 0 ? ImpactEasing::Smooth : ImpactEasing::Linear;
    ImpactCurve& curve = impact.curve;
    curve.s_in = random.uniform(0.5, 2.0);
    curve.s_mid = random.uniform(0.3, 1.0);
    curve.s_out = random.uniform(0.5, 2.0);
    const int kind = random.below(5);
    curve.t_in = kind == 0 || kind == 2 ? 0.0 : random.uniform(1e-6, 0.5);
    curve.t_out = kind == 1 || kind == 2 ? 0.0 : random.uniform(1e-6, 0.5);
    curve.omega_in = curve.t_in > 0.0 ? 0.5 * kPi / curve.t_in : 0.0;
    curve.omega_out = curve.t_out > 0.0 ? 0.5 * kPi / curve.t_out : 0.0;
    Phase phase;
    phase.start = impact.begun;
    phase.end = impact.begun + curve.duration();
    phase.motion = impact;
    return phase;
}

TEST(MatrixTable, LanesOfImpactsAreWhatThePosesSay) {
    Random random(19);
    const std::vector<ShapePtr> shapes{valueOf(Shape::sphere(0.5, 8)), valueOf(Shape::box({0.3, 0.5, 0.4}))};
    const ShapePtr solid = valueOf(Shape::box({2.0, 0.8, 2.0}));
    for (int i = 0; i < 200 * soak(); ++i) {
        ImpactLanes lanes;
        const double share = random.below(4) * 0.25 + random.below(2) * random.uniform(0.0, 0.25);
        std::vector<Phase> phases;
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            phases.push_back(anyImpact(random, solid));
            Phase& phase = phases.back();
            // All are looked at at the same time.
            Impact& impact = phase.edit<Impact>();
            impact.begun = phase.start = 200.0 - share * impact.curve.duration();
            // What turned before its phase began has turned since.
            const double turned = turnShare(impact.curve, impact.easing, 200.0 - impact.begun);
            impact.turn_from = random.below(2) == 0 ? 0.0 : random.uniform(0.0, 0.9) * turned;
            ASSERT_TRUE(ImpactLanes::fits(phase));
            lanes.set(lane, impact, *shapes[lane % 2]);
        }
        Columns columns;
        poseImpacts(lanes, kLanes, 200.0, columns);
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const Pose pose = poseAt(phases[lane], *shapes[lane % 2], 200.0);
            const Mat3 linear = linearOf(pose);
            for (int k = 0; k < 12; ++k) {
                const double value = k < 9 ? linear[k / 3][k % 3] : pose.position[k - 9];
                ASSERT_EQ(columns[static_cast<std::size_t>(k)][lane], static_cast<float>(value))
                    << "number " << k << " of case " << i << ", at " << share;
            }
        }
    }
}

TEST(MatrixTable, DrawingShowsNowhereElse) {
    const std::string source = ELASTOON_SOURCE_DIR;
    for (const Golden& golden : valueOf(readGoldens(source + "/tests/golden/hashes.txt"))) {
        const Scene scene = valueOf(readScene(source + "/scenes/" + golden.scene));
        StagedScene drawn = valueOf(stage(scene));
        StagedScene plain = valueOf(stage(scene));
        for (int k = 0; k < 240; ++k) {
            drawn.world.step(1.0 / golden.fps);
            plain.world.step(1.0 / golden.fps);
            (void)drawn.world.matrices();
            ASSERT_TRUE(drawn.world.snapshot() == plain.world.snapshot()) << golden.scene << ", step " << k;
            for (const BodyId id : drawn.world.bodies()) {
                const Prediction after_drawing = drawn.world.predict(id, 0.05);
                const Prediction prediction = plain.world.predict(id, 0.05);
                ASSERT_EQ(after_drawing.events.size(), prediction.events.size());
                const Shape& shape = *drawn.world.shape(id);
                const double t = drawn.world.time() + 0.05;
                ASSERT_EQ(after_drawing.poseAt(shape, t).position, prediction.poseAt(shape, t).position);
                ASSERT_EQ(drawn.world.velocity(id), plain.world.velocity(id));
                ASSERT_EQ(drawn.world.phase(id).free_from, plain.world.phase(id).free_from);
            }
        }
        EXPECT_EQ(drawn.world.stateHash(), plain.world.stateHash());
    }
}

TEST(MatrixTable, LanesGiveBackTheFlightToTheBit) {
    Random random(23);
    for (int i = 0; i < 2000 * soak(); ++i) {
        const Vec3 gravity = std::array{Vec3(0.0, -9.81, 0.0), Vec3(0.0), Vec3(3.0, -5.0, 1.0)}.at(
            static_cast<std::size_t>(random.below(3)));
        const int kind = random.below(4);
        const Vec3 velocity = kind == 0   ? Vec3(0.0)
                              : kind == 1 ? gravity * random.uniform(-1.0, 1.0)
                                          : random.inBox(9.0);
        const Pose pose{random.inBox(5.0), random.rotation(), 1.0};
        const Flight flight = beginFlight(pose, velocity, gravity, Style{}, Lead::PlusX);
        FlightLanes lanes;
        const auto lane = static_cast<std::size_t>(random.below(kLanes));
        lanes.set(lane, 2.5, flight);
        Flight back;
        lanes.get(lane, gravity, back);
        ASSERT_EQ(back.rule, flight.rule);
        ASSERT_EQ(back.turn_axis, flight.turn_axis);
        ASSERT_EQ(back.climb, flight.climb);
        ASSERT_EQ(back.speed_across, flight.speed_across);
        const double t = random.uniform(0.0, 2.0);
        ASSERT_EQ(unpushedPose(back, t).orientation, unpushedPose(flight, t).orientation);
        ASSERT_EQ(unpushedPose(back, t).position, unpushedPose(flight, t).position);
        ASSERT_EQ(unpushedPose(back, t).stretch, unpushedPose(flight, t).stretch);
        Columns columns;
        poseFlights(lanes, Falling(gravity), 2.5 + t, columns);
        const Mat3 linear = linearOf(unpushedPose(flight, 2.5 + t - 2.5));
        for (int k = 0; k < 9; ++k) {
            ASSERT_EQ(columns[static_cast<std::size_t>(k)][lane], static_cast<float>(linear[k / 3][k % 3])) << i;
        }
    }
}

/// One change or none, the same for the same state of `random`.
void changeSomething(World& world, ObstacleId floor, std::vector<BodyId>& bodies, Random& random) {
    const auto some = static_cast<std::size_t>(random.below(static_cast<int>(bodies.size())));
    switch (random.below(14)) {
    case 0:
        ASSERT_TRUE(world.removeBody(bodies[some]));
        bodies[some] = valueOf(world.addBody(thrown(random)));
        break;
    case 1:
        (void)world.setVelocity(bodies[some], random.inBox(5.0));
        break;
    case 2:
        (void)world.setPosition(bodies[some], {0.0, random.uniform(2.0, 9.0), 0.0});
        break;
    case 3:
        bodies.push_back(valueOf(world.addBody(thrown(random))));
        break;
    case 4:
        ASSERT_TRUE(world.setObstacleMotion(floor, {0.0, random.uniform(-0.2, 0.2), 0.0}, Vec3(0.0)));
        break;
    case 5:
        ASSERT_TRUE(world.setGravity(world.gravity() * random.uniform(0.8, 1.2)));
        break;
    case 6: {
        Style style;
        style.max_stretch = random.uniform(1.0, 2.0);
        ASSERT_TRUE(world.setStyle(bodies[some], style));
        break;
    }
    default:
        break;
    }
}

TEST(MatrixTable, FollowsAllThatUsersChange) {
    Random random(77);
    for (const Vec3& gravity : {Vec3(0.0, -9.81, 0.0), Vec3(0.0), Vec3(1.0, -5.0, 2.0)}) {
        World world = worldWith(gravity);
        World never_drawn = worldWith(gravity);
        const ObstacleId floor = valueOf(world.addObstacle(ObstacleDef::plane({0, 1, 0}, 0.0)));
        ASSERT_EQ(valueOf(never_drawn.addObstacle(ObstacleDef::plane({0, 1, 0}, 0.0))), floor);
        std::vector<BodyId> bodies;
        for (int i = 0; i < 70; ++i) {
            const BodyDef def = thrown(random);
            bodies.push_back(valueOf(world.addBody(def)));
            ASSERT_EQ(valueOf(never_drawn.addBody(def)), bodies.back());
        }
        std::vector<BodyId> same_bodies = bodies;
        const std::vector<std::byte> early = world.snapshot();
        for (int k = 0; k < 300; ++k) {
            Random same = random;
            changeSomething(world, floor, bodies, random);
            changeSomething(never_drawn, floor, same_bodies, same);
            if (k % 3 != 0) {
                ASSERT_EQ(differences(world), 0) << "step " << k;
            }
            world.step(1.0 / 30.0);
            never_drawn.step(1.0 / 30.0);
            ASSERT_EQ(world.stateHash(), never_drawn.stateHash()) << "step " << k;
            ASSERT_TRUE(world.snapshot() == never_drawn.snapshot()) << "step " << k;
        }
        ASSERT_EQ(differences(world), 0);
        ASSERT_TRUE(world.restore(early));
        EXPECT_EQ(differences(world), 0);
        EXPECT_EQ(world.matrices().size(), 12U * 70U);
    }
}

} // namespace
} // namespace elastoon
