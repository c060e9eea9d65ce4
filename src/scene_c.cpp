// The C interface to scenes. See elastoon.h.
#include "elastoon/scene.h"

#include "c_interface.h"
#include "check_input.h"

#include <memory>
#include <string>
#include <vector>

using namespace elastoon;
using namespace elastoon::c_interface;

namespace {

/// A scene with what its C definitions point to.
struct HeldScene {
    Scene scene;
    std::vector<ElastoonShape> shapes;
    std::vector<std::vector<ElastoonPathKey>> paths; ///< of each obstacle

    HeldScene() = default;
    HeldScene(const HeldScene&) = delete;
    HeldScene& operator=(const HeldScene&) = delete;
    ~HeldScene() {
        for (const ElastoonShape shape : shapes) {
            c_interface::shapes().remove({shape.slot, shape.generation});
        }
    }
};

Table<HeldScene>& scenes() {
    static Table<HeldScene>* const kTable = new Table<HeldScene>();
    return *kTable;
}

HeldScene* find(ElastoonScene id) {
    return scenes().find({id.slot, id.generation});
}

ElastoonResult badIndex() {
    return refuse(kElastoonBadArgument, "the scene has fewer of these", "index");
}

ElastoonResult hold(Scene scene, ElastoonScene* out_scene) {
    auto held = std::make_unique<HeldScene>();
    for (const SceneShape& shape : scene.shapes) {
        ElastoonShape id{};
        if (const ElastoonResult given = giveId(shape.shape, &id); given != kElastoonOk) {
            return given;
        }
        held->shapes.push_back(id);
    }
    for (const SceneObstacle& obstacle : scene.obstacles) {
        std::vector<ElastoonPathKey>& keys = held->paths.emplace_back();
        for (const PathKey& key : obstacle.def.path) {
            keys.push_back({key.time, toC(key.position), toC(key.rotation)});
        }
    }
    held->scene = std::move(scene);
    const auto key = scenes().add(std::move(held));
    if (key.slot == 0) {
        return refuse(kElastoonRefused, "there are too many scenes; destroy those that are not needed");
    }
    *out_scene = {key.slot, key.generation};
    return kElastoonOk;
}

} // namespace

ElastoonResult elastoonSceneParse(const char* text, size_t length, const char* file, ElastoonScene* out_scene) {
    return guarded([&] {
        if (text == nullptr || out_scene == nullptr) {
            return nullPointer("text and out_scene");
        }
        auto scene = parseScene({text, length}, file != nullptr ? file : "");
        return scene ? hold(std::move(scene).value(), out_scene) : refuse(kElastoonBadData, scene.error());
    });
}

ElastoonResult elastoonSceneDestroy(ElastoonScene scene) {
    return scenes().remove({scene.slot, scene.generation}) != nullptr ? kElastoonOk : badId("scene");
}

bool elastoonSceneIsValid(ElastoonScene scene) {
    return find(scene) != nullptr;
}

ElastoonResult elastoonSceneInfo(ElastoonScene scene, ElastoonSceneInfo* out_info) {
    const HeldScene* held = find(scene);
    if (held == nullptr) {
        return badId("scene");
    }
    if (out_info == nullptr) {
        return nullPointer("out_info");
    }
    const Scene& read = held->scene;
    const SceneCamera camera = read.camera.value_or(SceneCamera{});
    *out_info = {read.name.c_str(),  toC(read.gravity),     read.duration,           read.shapes.size(),
                 read.bodies.size(), read.obstacles.size(), read.camera.has_value(), toC(camera.eye),
                 toC(camera.target), camera.fov_degrees};
    return kElastoonOk;
}

ElastoonResult elastoonSceneShape(ElastoonScene scene, size_t index, const char** out_name, ElastoonShape* out_shape) {
    const HeldScene* held = find(scene);
    if (held == nullptr) {
        return badId("scene");
    }
    if (out_shape == nullptr) {
        return nullPointer("out_shape");
    }
    if (index >= held->shapes.size()) {
        return badIndex();
    }
    if (out_name != nullptr) {
        *out_name = held->scene.shapes[index].name.c_str();
    }
    *out_shape = held->shapes[index];
    return kElastoonOk;
}

ElastoonResult elastoonSceneBody(ElastoonScene scene, size_t index, ElastoonSceneBody* out_body) {
    const HeldScene* held = find(scene);
    if (held == nullptr) {
        return badId("scene");
    }
    if (out_body == nullptr) {
        return nullPointer("out_body");
    }
    if (index >= held->scene.bodies.size()) {
        return badIndex();
    }
    const SceneBody& body = held->scene.bodies[index];
    *out_body = {body.name.c_str(),
                 body.shape,
                 {held->shapes[body.shape], toC(body.def.style), toC(body.def.position), toC(body.def.velocity),
                  toC(body.def.rotation), body.def.user_data},
                 toC(body.color)};
    return kElastoonOk;
}

ElastoonResult elastoonSceneObstacle(ElastoonScene scene, size_t index, ElastoonSceneObstacle* out_obstacle) {
    const HeldScene* held = find(scene);
    if (held == nullptr) {
        return badId("scene");
    }
    if (out_obstacle == nullptr) {
        return nullPointer("out_obstacle");
    }
    if (index >= held->scene.obstacles.size()) {
        return badIndex();
    }
    const SceneObstacle& obstacle = held->scene.obstacles[index];
    const ObstacleDef& def = obstacle.def;
    const std::vector<ElastoonPathKey>& path = held->paths[index];
    const ElastoonShape shape = obstacle.shape ? held->shapes[*obstacle.shape] : ElastoonShape{};
    *out_obstacle = {obstacle.name.c_str(),
                     obstacle.shape.has_value(),
                     obstacle.shape.value_or(0),
                     {shape, toC(def.normal), toC(def.position), toC(def.rotation), toC(def.velocity),
                      toC(def.angular_velocity), path.empty() ? nullptr : path.data(), path.size(), def.path_repeats,
                      def.user_data},
                     toC(obstacle.color)};
    return kElastoonOk;
}

ElastoonResult elastoonSceneObstacleFrame(ElastoonScene scene, size_t index, double time,
                                          ElastoonObstacleFrame* out_frame) {
    const HeldScene* held = find(scene);
    if (held == nullptr) {
        return badId("scene");
    }
    if (out_frame == nullptr) {
        return nullPointer("out_frame");
    }
    if (index >= held->scene.obstacles.size()) {
        return badIndex();
    }
    if (!(time >= 0.0 && time <= kMostStep)) {
        return refuse(kElastoonBadArgument, "must be from 0 to 1e6 s", "time");
    }
    const MovingFrame frame = frameAt(held->scene.obstacles[index].def, 0.0, time);
    *out_frame = {toC(frame.originAt(time)), toC(frame.orientationAt(time)), toC(frame.velocity),
                  toC(frame.angular_velocity)};
    return kElastoonOk;
}

ElastoonResult elastoonSceneStage(ElastoonScene scene, ElastoonWorld* out_world) {
    return guarded([&] {
        const HeldScene* held = find(scene);
        if (held == nullptr) {
            return badId("scene");
        }
        if (out_world == nullptr) {
            return nullPointer("out_world");
        }
        auto staged = stage(held->scene);
        return staged ? giveId(std::move(staged).value().world, out_world) : refuse(kElastoonRefused, staged.error());
    });
}
