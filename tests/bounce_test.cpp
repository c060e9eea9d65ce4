// The whole bounce of a dropped ball against its closed form, for both squash laws.
#include "test_support.h"

#include <cmath>
#include <vector>

namespace elastoon {
namespace {

struct Expected {
    long double time;
    EventType type;
};

/// The same motion by hand, in extended precision: a fall, then hops of 2 v / g between impacts that take t_in + t_out.
std::vector<Expected> bounceByHand(SquashLaw law, long double height) {
    const long double g = 9.81L, r = 0.5L, s_max = 2.0L, s_min = 0.5L, k = 0.1L, length = 1.0L;
    const auto stretch = [&](long double v) { return (k * v * s_max + 1) / (k * v + 1); };
    const long double rest_speed = std::sqrt(2 * g * 0.02L * length);
    long double low = 0.0L, high = std::sqrt(2 * height / g);
    for (int i = 0; i < 200; ++i) {
        const long double t = (low + high) / 2;
        (height - g * t * t / 2 > length / 2 * stretch(g * t) ? low : high) = t;
    }
    std::vector<Expected> events;
    long double t = low;
    long double v = g * low;
    for (;;) {
        events.push_back({t, EventType::Impact});
        const long double s_in = stretch(v);
        const long double s_mid =
            law == SquashLaw::Paper ? 1 - (1 - s_min) * s_in / s_max : 1 - (1 - s_min) * (s_in - 1) / (s_max - 1);
        const long double omega_in = v / (length * (s_in - s_mid));
        const bool rests = r * v < rest_speed;
        const long double v_out = rests ? 0 : r * v;
        const long double s_out = stretch(v_out);
        const long double omega_out = std::max(v_out / (length * (s_out - s_mid)), omega_in / 2);
        t += std::acos(-1.0L) / 2 * (1 / omega_in + 1 / omega_out);
        events.push_back({t, rests ? EventType::Rest : EventType::Release});
        if (rests) {
            return events;
        }
        t += 2 * v_out / g;
        v = v_out;
    }
}

TEST(Bounce, SequenceIsTheClosedForm) {
    for (const SquashLaw law : {SquashLaw::Paper, SquashLaw::Bounded}) {
        const double height = 10.7917;
        World world = worldWithFloor();
        BodyDef def;
        def.shape = valueOf(Shape::sphere(0.5));
        def.style.squash_law = law;
        def.position = {0.0, height, 0.0};
        const BodyId ball = valueOf(world.addBody(def));
        Timeline timeline;
        timeline.begin(world);
        const std::vector<Expected> expected = bounceByHand(law, height);
        for (int i = 0; i < 60 * 15; ++i) {
            world.step(1.0 / 60.0);
            timeline.capture(world);
        }
        ASSERT_EQ(timeline.events().size(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i) {
            EXPECT_EQ(timeline.events()[i].type, expected[i].type);
            EXPECT_NEAR(timeline.events()[i].time, static_cast<double>(expected[i].time), 1e-7) << i;
        }
        EXPECT_NEAR(world.pose(ball).position.y, 0.5, 1e-12) << "at rest, round, on the floor";
        EXPECT_EQ(world.pose(ball).stretch, 1.0);
    }
}

TEST(Bounce, CheckFiguresComeOutAsAnEvent) {
    World world = worldWithFloor();
    BodyDef def;
    def.shape = valueOf(Shape::sphere(0.5));
    def.style.squash_law = SquashLaw::Paper;
    const double s_in = stretchAtSpeed(def.style, std::sqrt(2.0 * 9.81 * 10.0));
    def.position = {0.0, 10.0 + 0.5 * s_in, 0.0};
    (void)valueOf(world.addBody(def));
    world.step(1.5);
    ASSERT_EQ(world.events().size(), 1U);
    const Event& event = world.events()[0];
    EXPECT_NEAR(event.speed, 14.007, 5e-4);
    EXPECT_NEAR(event.s_in, 1.5835, 1e-4);
    EXPECT_NEAR(event.s_mid, 0.6041, 1e-4);
    EXPECT_NEAR(event.t_in, 0.1098, 1e-4);
    EXPECT_NEAR(event.s_out, 1.4119, 1e-4);
    EXPECT_NEAR(event.t_out, 0.1812, 1e-4);
    EXPECT_LT(glm::length(event.point), 1e-9);
    EXPECT_EQ(event.normal, Vec3(0, 1, 0));
}

} // namespace
} // namespace elastoon
