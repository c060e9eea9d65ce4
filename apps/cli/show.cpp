// See show.h.
#include "show.h"

#include <algorithm>
#include <optional>

namespace elastoon {

namespace {

constexpr double kLevel = 0.9999; // cosine to up from which a plane is the ground

struct Box {
    Vec3 low{0.0}, high{0.0};

    [[nodiscard]] Vec3 centre() const { return (low + high) / 2.0; }
    [[nodiscard]] double radius() const { return glm::length(high - low) / 2.0; }
};

Box boxOf(const std::vector<Vec3>& points) {
    Box box;
    if (!points.empty()) {
        box = {points.front(), points.front()};
    }
    for (const Vec3& point : points) {
        box.low = glm::min(box.low, point);
        box.high = glm::max(box.high, point);
    }
    return box;
}

bool isGround(const SceneObstacle& obstacle, const Vec3& up) {
    const Quat rotation = glm::normalize(obstacle.def.rotation);
    return !obstacle.shape && glm::dot(rotation * glm::normalize(obstacle.def.normal), up) > kLevel;
}

/// Height of the first level plane, along up.
std::optional<double> groundHeight(const Scene& scene, const Vec3& up) {
    for (const SceneObstacle& obstacle : scene.obstacles) {
        if (isGround(obstacle, up)) {
            return glm::dot(obstacle.def.position, up);
        }
    }
    return std::nullopt;
}

Setting settingAbout(const std::vector<Vec3>& points, const Camera& camera, const Vec3& up) {
    const Box box = boxOf(points);
    Setting setting;
    setting.origin = box.centre();
    setting.radius = static_cast<float>(box.radius() > 0.0 ? box.radius() : 1.0);
    setting.up = glm::vec3(up);
    const Vec3 level = camera.right - up * glm::dot(camera.right, up);
    const Vec3 side = glm::length(level) > 1e-6 ? glm::normalize(level) : camera.right;
    const Vec3 to_viewer = glm::cross(side, up);
    setting.to_light = glm::vec3(glm::normalize(up * 0.9 - side * 0.40 + to_viewer * 0.34));
    return setting;
}

std::vector<double> timesOf(const Timeline& timeline, const ShowSpan& span) {
    std::size_t vertices = 1;
    for (const Track& track : timeline.tracks()) {
        vertices += track.shape()->vertices().size();
    }
    const std::size_t steps = std::clamp<std::size_t>(1'000'000 / vertices, 40, 600);
    std::vector<double> times;
    for (std::size_t i = 0; i <= steps; ++i) {
        times.push_back(span.from + (span.to - span.from) * static_cast<double>(i) / static_cast<double>(steps));
    }
    return times;
}

/// Solids that belong to the action: neither much larger than it nor far away.
void addSolids(const Scene& scene, std::vector<Vec3>& points) {
    const Box action = boxOf(points);
    for (const SceneObstacle& obstacle : scene.obstacles) {
        if (!obstacle.shape) {
            continue;
        }
        const ShapePtr& shape = scene.shapes[*obstacle.shape].shape;
        const double distance = glm::length(obstacle.def.position - action.centre());
        if (shape->boundingRadius() > action.radius() || distance > 1.5 * action.radius()) {
            continue;
        }
        const MovingFrame frame = frameAt(obstacle.def, 0.0, 0.0);
        for (const Vec3& vertex : shape->vertices()) {
            points.push_back(frame.worldFromFrame(0.0, vertex));
        }
    }
}

} // namespace

std::vector<Vec3> actionPoints(const Scene& scene, const Timeline& timeline, const ShowSpan& span) {
    const Vec3 up = upOf(scene.gravity);
    std::vector<Vec3> points, feet;
    const std::optional<double> ground = groundHeight(scene, up);
    for (const double t : timesOf(timeline, span)) {
        for (const Track& track : timeline.tracks()) {
            Pose pose = track.poseAt(t);
            pose.position += span.spread * t;
            for (const Vec3& vertex : track.shape()->vertices()) {
                points.push_back(worldFromShape(pose, vertex));
            }
            if (ground) {
                feet.push_back(pose.position - up * (glm::dot(pose.position, up) - *ground));
            }
        }
    }
    const Box action = boxOf(points);
    for (const Vec3& foot : feet) { // ground that is far below what happens is not worth a small picture
        if (glm::length(foot - action.centre()) < 2.0 * action.radius()) {
            points.push_back(foot);
        }
    }
    addSolids(scene, points);
    return points;
}

Result<Show> Show::create(const Scene& scene, const Timeline& timeline, const ShowSpan& span, PictureSize size,
                          const TraceOptions& options) {
    auto tracer = Tracer::create(size, options);
    if (!tracer) {
        return tracer.error();
    }
    Show show(scene, timeline, span, std::move(tracer).value());
    const Vec3 up = upOf(scene.gravity);
    const double aspect = static_cast<double>(size.width) / static_cast<double>(size.height);
    const std::vector<Vec3> points = actionPoints(scene, timeline, span);
    show.camera_ = scene.camera ? cameraFrom(*scene.camera, up, aspect) : cameraAround(points, up, aspect);
    show.setting_ = settingAbout(points, show.camera_, up);
    show.addMeshes();
    show.placeAt(span.from);
    return show;
}

void Show::addMeshes() {
    for (const Track& track : timeline_->tracks()) {
        body_meshes_.push_back(tracer_.addMesh(drawnMesh(*track.shape(), true)));
    }
    for (const SceneObstacle& obstacle : scene_->obstacles) {
        const bool solid = obstacle.shape.has_value();
        obstacle_meshes_.push_back(solid ? tracer_.addMesh(drawnMesh(*scene_->shapes[*obstacle.shape].shape, false))
                                         : 0);
    }
}

void Show::placeAt(double t) {
    Setting setting = setting_;
    const Vec3 up = upOf(scene_->gravity);
    std::vector<Thing> solids;
    for (std::size_t i = 0; i < scene_->obstacles.size(); ++i) {
        const SceneObstacle& obstacle = scene_->obstacles[i];
        const MovingFrame frame = frameAt(obstacle.def, 0.0, t);
        if (obstacle.shape) {
            solids.push_back(
                {obstacle_meshes_[i], {frame.originAt(t), frame.orientationAt(t), 1.0}, thingColors(obstacle.color)});
            continue;
        }
        DrawnPlane plane;
        plane.point = setting.local(frame.originAt(t));
        plane.normal = glm::vec3(frame.orientationAt(t) * glm::normalize(obstacle.def.normal));
        plane.color = linearFromSrgb(obstacle.color) / linearFromSrgb(kDefaultObstacleColor);
        if (!setting.ground && glm::dot(Vec3(plane.normal), up) > kLevel) {
            setting.ground = plane;
        } else {
            setting.walls.push_back(plane);
        }
    }
    tracer_.place(setting, camera_, solids);
    placed_at_ = t;
}

bool Show::obstaclesMove() const {
    return std::any_of(scene_->obstacles.begin(), scene_->obstacles.end(),
                       [](const SceneObstacle& obstacle) { return obstacle.def.moves(); });
}

void Show::setTime(double t) {
    if (obstaclesMove() && t != placed_at_) {
        placeAt(t);
    }
}

bool Show::changes(double a, double b) const {
    return obstaclesMove() ||
           std::any_of(timeline_->tracks().begin(), timeline_->tracks().end(), [&](const Track& track) {
               const Pose before = track.poseAt(a), after = track.poseAt(b);
               return before.position != after.position || before.orientation != after.orientation ||
                      before.stretch != after.stretch;
           });
}

std::vector<Thing> Show::bodiesAt(double t) const {
    std::vector<Thing> things;
    const std::vector<Track>& tracks = timeline_->tracks();
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        Pose pose = tracks[i].poseAt(t);
        pose.position += span_.spread * t;
        const Vec3 color = i < scene_->bodies.size() ? scene_->bodies[i].color : Vec3(0.89, 0.34, 0.18);
        things.push_back({body_meshes_[i], pose, thingColors(color)});
    }
    return things;
}

} // namespace elastoon
