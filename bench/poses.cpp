// See poses.h.
#include "poses.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace elastoon {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Gap along `direction` (from the other to the body) between planes across it.
void placeAt(const DistanceScene& scene, Pose& pose, const Vec3& direction, double gap) {
    const double reach =
        bruteReach(*scene.body.shape, pose, -direction) + bruteReach(*scene.other, scene.other_pose, direction) + gap;
    const Vec3 across = pose.position - direction * glm::dot(pose.position, direction);
    pose.position = across + direction * (glm::dot(scene.other_pose.position, direction) + reach);
}

DistanceScene sceneOf(const char* kind, const BenchBody& body, bool on_floor) {
    DistanceScene scene;
    scene.cell = std::string(kind) + (on_floor ? " floor " : " copy ") + body.name;
    scene.body = body;
    scene.other = on_floor ? benchFloor() : body.shape;
    scene.other_pose = on_floor ? kFloorPose : Pose{Vec3(0.0), glm::angleAxis(1.0, Vec3(0.36, 0.48, 0.8)), 1.0};
    return scene;
}

} // namespace

const std::vector<BenchBody>& benchBodies() {
    static const std::vector<BenchBody> kBodies{{"box8", Shape::box({1.0, 0.7, 0.8}).value()},
                                                {"cylinder24", Shape::cylinder(0.4, 1.0, 12).value()},
                                                {"sphere66", Shape::sphere(0.5, 4).value()},
                                                {"sphere258", Shape::sphere(0.5, 8).value()},
                                                {"sphere1026", Shape::sphere(0.5, 16).value()}};
    return kBodies;
}

const ShapePtr& benchFloor() {
    static const ShapePtr kFloor = Shape::box({10.0, 1.0, 10.0}).value();
    return kFloor;
}

double bruteReach(const Shape& shape, const Pose& pose, const Vec3& direction) {
    const Vec3 in_shape = scaleOf(pose.stretch) * (glm::conjugate(pose.orientation) * direction);
    double reach = -std::numeric_limits<double>::infinity();
    for (const Vec3& vertex : shape.vertices()) {
        reach = std::max(reach, glm::dot(in_shape, vertex));
    }
    return reach;
}

DistanceScene coherentScene(const BenchBody& body, bool on_floor, bool quick) {
    DistanceScene scene = sceneOf("coherent", body, on_floor);
    scene.coherent = true;
    constexpr int kSteps = 720; // 12 s; every part below comes back to where it began
    const Vec3 first_axis = glm::normalize(Vec3(1.0, 2.0, 0.5));
    const Vec3 second_axis = glm::normalize(Vec3(-0.3, 0.4, 1.0));
    for (int i = 0; i < (quick ? kSteps / 3 : kSteps); ++i) {
        const double t = kTurn * i / kSteps;
        Pose pose;
        pose.stretch = std::exp2(std::sin(4.0 * t));
        pose.orientation = glm::angleAxis(5.0 * t, first_axis) * glm::angleAxis(3.0 * t, second_axis);
        const double gap = 0.11 + 0.09 * std::sin(7.0 * t);
        if (on_floor) {
            pose.position = {1.5 * std::cos(t), 0.0, 1.5 * std::sin(2.0 * t)};
        }
        const Vec3 around(std::cos(t), 0.6 * std::sin(2.0 * t), std::sin(t));
        placeAt(scene, pose, on_floor ? Vec3(0.0, 1.0, 0.0) : glm::normalize(around), gap);
        scene.poses.push_back(pose);
    }
    return scene;
}

DistanceScene randomScene(const BenchBody& body, bool on_floor, bool quick) {
    DistanceScene scene = sceneOf("random", body, on_floor);
    BenchRandom random(19);
    for (int i = 0; i < (quick ? 200 : 500); ++i) {
        Pose pose;
        pose.stretch = std::exp2(random.uniform(-1.0, 1.0));
        pose.orientation = random.rotation();
        if (on_floor) {
            // A third of them past its edges.
            const double x = random.uniform(-6.0, 6.0);
            pose.position = {x, 0.0, random.uniform(-6.0, 6.0)};
        }
        const Vec3 direction = random.direction();
        placeAt(scene, pose, on_floor ? Vec3(0.0, 1.0, 0.0) : direction, random.uniform(0.01, 0.5));
        scene.poses.push_back(pose);
    }
    return scene;
}

} // namespace elastoon
