// The automatic camera holds the whole action with its margin, and wastes no room.
#include "camera.h"
#include "show.h"

#include "test_support.h"

#include <cmath>

namespace elastoon {
namespace {

constexpr double kMargin = 0.08;

TEST(Camera, FramesEveryCloudWithMarginAndNoMore) {
    Random random(7);
    for (const double aspect : {16.0 / 9.0, 1.0, 9.0 / 16.0, 3.0}) {
        for (int round = 0; round < 50; ++round) {
            const Vec3 size(random.uniform(0.01, 30.0), random.uniform(0.01, 30.0), random.uniform(0.01, 8.0));
            const Vec3 centre = random.inBox(100.0);
            std::vector<Vec3> points;
            for (int i = 0; i < 40; ++i) {
                points.push_back(centre + random.inBox(1.0) * size);
            }
            const Vec3 up = round % 2 == 0 ? Vec3(0.0, 1.0, 0.0) : random.direction();
            const Camera camera = cameraAround(points, up, aspect, kMargin);
            double widest = 0.0;
            for (const Vec3& point : points) {
                const Vec3 at = camera.project(point);
                ASSERT_GT(at.z, 0.0);
                ASSERT_LE(std::max(std::fabs(at.x), std::fabs(at.y)), 1.0 - 2.0 * kMargin + 1e-9);
                widest = std::max({widest, std::fabs(at.x), std::fabs(at.y)});
            }
            EXPECT_NEAR(widest, 1.0 - 2.0 * kMargin, 1e-6);
        }
    }
}

TEST(Camera, DirectionsAreAtRightAnglesAndUpIsUp) {
    Random random(11);
    for (int round = 0; round < 50; ++round) {
        const Vec3 up = random.direction();
        const Camera camera = cameraAround({}, up, 1.5);
        const Mat3 frame(camera.right, camera.up, -camera.forward);
        EXPECT_NEAR(glm::determinant(frame), 1.0, 1e-12);
        EXPECT_GT(glm::dot(camera.up, up), 0.9);
        EXPECT_LT(glm::dot(camera.forward, up), 0.0); // from slightly above
        EXPECT_NEAR(glm::dot(camera.right, up), 0.0, 1e-12);
    }
    const Camera camera = cameraAround({}, upOf({0.0, -9.81, 0.0}), 1.5);
    EXPECT_NEAR(camera.right.x, 1.0, 1e-12); // x runs to the right
    EXPECT_LT(camera.forward.z, -0.95);
}

TEST(Camera, OnePointIsInTheMiddle) {
    const std::vector<Vec3> points{{3.0, 2.0, 1.0}};
    const Vec3 at = cameraAround(points, {0.0, 1.0, 0.0}, 1.5).project(points[0]);
    EXPECT_GT(at.z, 0.0);
    EXPECT_NEAR(at.x, 0.0, 1e-6);
    EXPECT_NEAR(at.y, 0.0, 1e-6);
}

TEST(Camera, NamedCameraLooksAtItsTargetWithItsAngle) {
    const Camera camera = cameraFrom({{1.0, 2.0, 8.0}, {1.0, 2.0, 0.0}, 90.0}, {0.0, 1.0, 0.0}, 2.0);
    const Vec3 middle = camera.project({1.0, 2.0, 0.0});
    EXPECT_NEAR(middle.x, 0.0, 1e-12);
    EXPECT_NEAR(middle.y, 0.0, 1e-12);
    EXPECT_NEAR(middle.z, 8.0, 1e-12);
    EXPECT_NEAR(camera.project({1.0, 10.0, 0.0}).y, 1.0, 1e-12);  // 45 degrees up: the upper border
    EXPECT_NEAR(camera.project({17.0, 2.0, 0.0}).x, 1.0, 1e-12); // twice as wide
    const Camera down = cameraFrom({{0.0, 9.0, 0.0}, {0.0, 0.0, 0.0}, 40.0}, {0.0, 1.0, 0.0}, 1.0);
    EXPECT_TRUE(std::isfinite(down.project({1.0, 0.0, 1.0}).x));
}

TEST(Camera, HoldsEveryPoseOfAScene) {
    const std::string text = R"({"elastoon": 1, "name": "t", "duration": 3,
        "shapes": {"ball": {"type": "sphere", "radius": 0.5}, "can": {"type": "cylinder", "radius": 0.3, "length": 1.2}},
        "bodies": [{"name": "a", "shape": "ball", "position": [0, 5, 0], "velocity": [1, 0, 0.5]},
                   {"name": "b", "shape": "can", "position": [-2, 3, 1], "velocity": [0.5, 4, 0]}],
        "obstacles": [{"name": "floor", "type": "plane", "normal": [0, 1, 0], "offset": 0}],
        "strobe": {"every": 0.1, "spread": [0.7, 0, 0]}})";
    const Scene scene = valueOf(parseScene(text));
    StagedScene staged = valueOf(stage(scene));
    Timeline timeline;
    timeline.begin(staged.world);
    for (int i = 0; i < 180; ++i) {
        staged.world.step(1.0 / 60.0);
        timeline.capture(staged.world);
    }
    const ShowSpan span{0.0, 3.0, scene.strobe.spread};
    const std::vector<Vec3> points = actionPoints(scene, timeline, span);
    for (const double aspect : {16.0 / 9.0, 0.6}) {
        const Camera camera = cameraAround(points, upOf(scene.gravity), aspect, kMargin);
        for (double t = 0.0; t <= 3.0; t += 0.0137) { // none of the times that the points were taken at
            for (const Track& track : timeline.tracks()) {
                Pose pose = track.poseAt(t);
                pose.position += span.spread * t;
                for (const Vec3& vertex : track.shape()->vertices()) {
                    const Vec3 at = camera.project(worldFromShape(pose, vertex));
                    ASSERT_LT(std::max(std::fabs(at.x), std::fabs(at.y)), 1.0 - 1.8 * kMargin);
                }
            }
        }
    }
}

} // namespace
} // namespace elastoon
