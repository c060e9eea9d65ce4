// Strobe pictures: exact times, ghosts that grow stronger, shadows that do not add up.
#include "strobe.h"

#include "test_support.h"

#include <array>
#include <cmath>

namespace elastoon {
namespace {

TEST(Strobe, TimesAreExactMultiplesAndBothEndsCount) {
    const std::vector<double> times = strobeTimes({0.1, Vec3(0.0), 0.5, 2.0}, 6.0);
    ASSERT_EQ(times.size(), 16U);
    for (std::size_t i = 0; i < times.size(); ++i) {
        EXPECT_EQ(times[i], 0.5 + static_cast<double>(i) * 0.1);
    }
    EXPECT_EQ(strobeTimes({0.25, Vec3(0.0), 0.0, -1.0}, 1.0).size(), 5U); // a negative end is the scene's
    EXPECT_TRUE(strobeTimes({0.25, Vec3(0.0), 2.0, 1.0}, 6.0).empty());
}

TEST(Strobe, WeightsGrowAndTheLastIsFull) {
    for (const std::size_t count : {2U, 3U, 50U}) {
        for (std::size_t i = 1; i < count; ++i) {
            EXPECT_GT(ghostWeight(i, count), ghostWeight(i - 1, count));
        }
        EXPECT_GT(ghostWeight(0, count), 0.2F);
        EXPECT_EQ(ghostWeight(count - 1, count), 1.0F);
    }
    EXPECT_EQ(ghostWeight(0, 1), 1.0F);
}

TEST(Strobe, KeysAreTheEndsTheSquashAndWhatHasRoom) {
    const ShapePtr ball = valueOf(Shape::sphere(0.5));
    const Quat upright = glm::angleAxis(1.5707963267948966, Vec3(0.0, 0.0, 1.0));
    std::vector<Pose> poses; // down, squashed, up; much closer than they are wide
    for (int i = 0; i <= 40; ++i) {
        const double height = std::fabs(static_cast<double>(i - 20)) * 0.15;
        const double stretch = i == 20 ? 0.6 : std::fabs(i - 20) < 3 ? 0.9 : 1.2;
        poses.push_back({{0.06 * i, 0.3 + height, 0.0}, upright, stretch});
    }
    const std::vector<bool> keys = keyGhosts(*ball, poses, {0.0, 1.0, 0.0});
    ASSERT_EQ(keys.size(), poses.size());
    EXPECT_TRUE(keys.front() && keys[20] && keys.back());
    int count = 0;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        count += keys[i] ? 1 : 0;
        for (std::size_t j = 0; j < i; ++j) {
            if (keys[i] && keys[j]) {
                EXPECT_GT(glm::length(poses[i].position - poses[j].position), 0.3) << i << ' ' << j;
            }
        }
    }
    EXPECT_GT(count, 5);
    EXPECT_LT(count, 15);
}

struct Studio {
    Studio() : tracer(valueOf(Tracer::create({192, 64}, {16, 0}))) {
        ball = tracer.addMesh(drawnMesh(*valueOf(Shape::sphere(0.5)), false));
        Setting setting;
        setting.radius = 3.0F;
        setting.to_light = glm::normalize(setting.to_light);
        setting.ground = DrawnPlane{};
        tracer.place(setting, cameraFrom({{0.0, 1.0, 12.0}, {0.0, 0.5, 0.0}, 16.0}, {0.0, 1.0, 0.0}, 3.0), {});
    }
    [[nodiscard]] Ghost ghost(double x, float weight, bool trail = false) const {
        return {{{ball, {{x, 0.5, 0.0}, kNoRotation, 1.0}, thingColors({0.8, 0.1, 0.1})}}, weight, trail};
    }

    Tracer tracer;
    std::size_t ball = 0;
};

/// How far the picture is from the background around the ghost that stands at pixel column x.
double strengthAt(const Picture& picture, const Picture& background, int x) {
    double sum = 0.0;
    for (int y = 0; y < picture.size.height; ++y) {
        for (int u = x - 3; u <= x + 3; ++u) {
            sum += glm::length(picture.at(u, y) - background.at(u, y));
        }
    }
    return sum;
}

TEST(Strobe, GhostsFadeMonotonically) {
    const Studio studio;
    std::vector<Ghost> ghosts;
    for (std::size_t i = 0; i < 5; ++i) {
        ghosts.push_back(studio.ghost(-3.2 + 1.6 * static_cast<double>(i), ghostWeight(i, 5)));
    }
    const Picture picture = strobePicture(studio.tracer, ghosts);
    std::vector<double> strengths;
    for (int i = 0; i < 5; ++i) {
        strengths.push_back(strengthAt(picture, studio.tracer.background(), 96 + (i - 2) * 30));
    }
    for (std::size_t i = 1; i < strengths.size(); ++i) {
        EXPECT_GT(strengths[i], 1.05 * strengths[i - 1]) << i;
    }
}

TEST(Strobe, AFullGhostIsThePicture) {
    const Studio studio;
    const std::array ghosts{studio.ghost(0.3, 1.0F)};
    const Picture strobe = strobePicture(studio.tracer, ghosts), plain = studio.tracer.picture(ghosts[0].things);
    for (std::size_t i = 0; i < strobe.pixels.size(); ++i) {
        ASSERT_LT(glm::length(strobe.pixels[i] - plain.pixels[i]), 1e-4F);
    }
}

TEST(Strobe, TheSameGhostTwiceIsNoDarker) {
    const Studio studio;
    const std::array once{studio.ghost(0.0, 1.0F)};
    const std::array twice{studio.ghost(0.0, 1.0F), studio.ghost(0.0, 1.0F)};
    const Picture a = strobePicture(studio.tracer, once), b = strobePicture(studio.tracer, twice);
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        ASSERT_LT(glm::length(a.pixels[i] - b.pixels[i]), 0.35F); // the ghost's own edge is laid twice
    }
    int changed = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        changed += glm::length(a.pixels[i] - b.pixels[i]) > 1e-5F ? 1 : 0;
    }
    EXPECT_LT(changed, 300); // only that edge
}

TEST(Strobe, TrailsAreFaintAndBehind) {
    const Studio studio;
    const std::array trail{studio.ghost(0.0, 1.0F, true)}, full{studio.ghost(0.0, 1.0F)};
    const std::array both{studio.ghost(0.0, 1.0F, true), studio.ghost(0.0, 1.0F)};
    const Picture& background = studio.tracer.background();
    const double faint = strengthAt(strobePicture(studio.tracer, trail), background, 96);
    const double strong = strengthAt(strobePicture(studio.tracer, full), background, 96);
    EXPECT_GT(faint, 0.02 * strong);
    EXPECT_LT(faint, 0.2 * strong);
    EXPECT_NEAR(strengthAt(strobePicture(studio.tracer, both), background, 96), strong, 0.02 * strong);
}

TEST(Strobe, StopsWhenTold) {
    const Studio studio;
    const std::array ghosts{studio.ghost(-2.0, 1.0F), studio.ghost(0.0, 1.0F), studio.ghost(2.0, 1.0F)};
    std::size_t steps = 0;
    static_cast<void>(strobePicture(studio.tracer, ghosts, [&](std::size_t index) {
        steps = index + 1;
        return index < 1;
    }));
    EXPECT_EQ(steps, 2U);
}

} // namespace
} // namespace elastoon
