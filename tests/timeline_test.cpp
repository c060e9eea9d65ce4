// The timeline: any time, exactly, also of bodies that come later.
#include "elastoon/timeline.h"

#include "test_support.h"

namespace elastoon {
namespace {

TEST(Timeline, GivesThePosesThatTheWorldHad) {
    World world = worldWithFloor();
    BodyDef def;
    def.shape = valueOf(Shape::cylinder(0.25, 1.0));
    def.position = {0.0, 4.0, 0.0};
    def.velocity = {2.0, 1.0, 0.0};
    const BodyId first = valueOf(world.addBody(def));
    Timeline timeline;
    timeline.begin(world);
    std::vector<std::pair<double, Pose>> seen;
    BodyId second;
    for (int i = 0; i < 400; ++i) {
        if (i == 100) {
            second = valueOf(world.addBody(def));
        }
        world.step(1.0 / 60.0);
        timeline.capture(world);
        seen.emplace_back(world.time(), world.pose(first));
    }
    ASSERT_EQ(timeline.tracks().size(), 2U);
    EXPECT_EQ(timeline.tracks()[1].body(), second);
    EXPECT_EQ(timeline.end(), world.time());
    for (auto entry = seen.rbegin(); entry != seen.rend(); ++entry) {
        const Pose pose = timeline.tracks()[0].poseAt(entry->first);
        EXPECT_EQ(pose.position, entry->second.position);
        EXPECT_EQ(pose.orientation, entry->second.orientation);
        EXPECT_EQ(pose.stretch, entry->second.stretch);
    }
    EXPECT_EQ(timeline.tracks()[0].poseAt(-5.0).position, def.position);
    EXPECT_GE(timeline.events().size(), 8U);
}

TEST(Timeline, KeepsUserChanges) {
    World world = worldWith({0, 0, 0});
    BodyDef def;
    def.shape = valueOf(Shape::box(Vec3(1.0)));
    const BodyId body = valueOf(world.addBody(def));
    Timeline timeline;
    timeline.begin(world);
    world.step(1.0);
    timeline.capture(world);
    ASSERT_TRUE(world.setVelocity(body, {1, 0, 0}).ok());
    world.step(1.0);
    timeline.capture(world);
    EXPECT_LT(glm::length(timeline.tracks()[0].poseAt(1.5).position - Vec3(0.5, 0, 0)), 1e-12);
    EXPECT_LT(glm::length(timeline.tracks()[0].poseAt(0.5).position), 1e-12);
}

TEST(Timeline, GoesAnotherWayAfterACut) {
    World world = worldWithFloor();
    BodyDef def;
    def.shape = valueOf(Shape::cylinder(0.25, 1.0));
    def.position = {0.0, 2.0, 0.0};
    def.velocity = {2.0, 1.0, 0.0};
    const BodyId first = valueOf(world.addBody(def));
    Timeline timeline;
    timeline.begin(world);
    const auto go = [&](int steps) {
        for (int i = 0; i < steps; ++i) {
            world.step(1.0 / 60.0);
            timeline.capture(world);
        }
    };
    go(70);
    const auto saved = world.snapshot();
    const std::size_t events = timeline.events().size();
    const double time = world.time();
    // A throw, and a body that a cut must forget.
    ASSERT_TRUE(world.setVelocity(first, {-3.0, 4.0, 0.0}).ok());
    ASSERT_TRUE(world.addBody(def).ok());
    go(100);
    ASSERT_EQ(timeline.tracks().size(), 2U);
    timeline.cut(70);
    EXPECT_EQ(timeline.tracks().size(), 1U);
    EXPECT_EQ(timeline.captures(), 70U);
    EXPECT_EQ(timeline.events().size(), events);
    EXPECT_EQ(timeline.end(), time);
    ASSERT_TRUE(world.restore(saved).ok());
    go(100);

    World straight = worldWithFloor();
    const BodyId same = valueOf(straight.addBody(def));
    Timeline whole;
    whole.begin(straight);
    for (int i = 0; i < 170; ++i) {
        straight.step(1.0 / 60.0);
        whole.capture(straight);
    }
    EXPECT_EQ(same, first);
    ASSERT_EQ(timeline.events().size(), whole.events().size());
    EXPECT_EQ(timeline.tracks()[0].phases().size(), whole.tracks()[0].phases().size());
    for (double t = 0.0; t < 3.0; t += 0.013) {
        const Pose pose = timeline.tracks()[0].poseAt(t), other = whole.tracks()[0].poseAt(t);
        EXPECT_EQ(pose.position, other.position);
        EXPECT_EQ(pose.stretch, other.stretch);
    }
    timeline.cut(0);
    EXPECT_EQ(timeline.end(), 0.0);
    EXPECT_TRUE(timeline.events().empty());
    EXPECT_EQ(timeline.tracks()[0].phases().size(), 1U);
}

} // namespace
} // namespace elastoon
