// Turns between directions: they arrive, they are the smallest, and the half turn goes the way it is told.
#include "rotation.h"
#include "test_support.h"

namespace elastoon {
namespace {

TEST(Rotation, BetweenRandomDirectionsArrivesByTheSmallestAngle) {
    Random random(4);
    for (int i = 0; i < 20000; ++i) {
        const Vec3 from = random.direction();
        Vec3 to = random.direction();
        if (i % 4 == 1) {
            to = glm::normalize(-from + 1e-7 * random.direction());
        } else if (i % 4 == 2) {
            to = glm::normalize(from + 1e-7 * random.direction());
        }
        const Quat q = rotationBetween(from, to);
        EXPECT_LT(glm::length(q * from - to), 1e-8);
        EXPECT_NEAR(glm::length(q), 1.0, 1e-15);
        EXPECT_NEAR(turnBetween(from, to).angle, std::atan2(glm::length(glm::cross(from, to)), glm::dot(from, to)),
                    1e-9);
    }
}

TEST(Rotation, HalfTurnGoesThroughTheGivenDirection) {
    Random random(5);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 from = random.direction();
        const Vec3 via = glm::normalize(glm::cross(from, random.direction()));
        const Turn turn = turnBetween(from, -from, via);
        EXPECT_NEAR(turn.angle, kPi, 1e-15);
        EXPECT_LT(glm::length(rotationAbout(turn.axis, kPi / 2) * from - via), 1e-12);
    }
}

TEST(Rotation, AnyAcrossIsUnitAndAcross) {
    Random random(6);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 d = random.direction();
        EXPECT_NEAR(glm::dot(anyAcross(d), d), 0.0, 1e-15);
        EXPECT_NEAR(glm::length(anyAcross(d)), 1.0, 1e-15);
    }
}

} // namespace
} // namespace elastoon
