// The C interface to obstacles. See elastoon.h.
#include "c_interface.h"

using namespace elastoon;
using namespace elastoon::c_interface;

namespace {

ElastoonResult change(ElastoonObstacle obstacle, const Input& input) {
    return guarded([&] {
        HeldWorld* held = worldOf(obstacle);
        return held == nullptr ? badId("obstacle") : resultOf(held->change(input));
    });
}

ElastoonObstacleDef cDefOf(const ObstacleDef& def) {
    return {{},
            toC(def.normal),
            toC(def.position),
            toC(def.rotation),
            toC(def.velocity),
            toC(def.angular_velocity),
            nullptr,
            0,
            def.path_repeats,
            def.user_data};
}

ElastoonResult fromObstacleDef(const ElastoonObstacleDef& def, ObstacleDef& out_def) {
    const bool is_plane = def.shape.slot == 0;
    const ShapePtr* shape = is_plane ? nullptr : find(def.shape);
    if (!is_plane && shape == nullptr) {
        return badId("shape");
    }
    if (def.path == nullptr && def.path_count > 0) {
        return nullPointer("path");
    }
    out_def.shape = is_plane ? nullptr : *shape;
    out_def.normal = from(def.normal);
    out_def.position = from(def.position);
    out_def.rotation = from(def.rotation);
    out_def.velocity = from(def.velocity);
    out_def.angular_velocity = from(def.angular_velocity);
    for (std::size_t i = 0; i < def.path_count; ++i) {
        const ElastoonPathKey& key = def.path[i];
        out_def.path.push_back({key.time, from(key.position), from(key.rotation)});
    }
    out_def.path_repeats = def.path_repeats;
    out_def.user_data = def.user_data;
    return kElastoonOk;
}

} // namespace

ElastoonObstacleDef elastoonDefaultObstacleDef(void) {
    return cDefOf(ObstacleDef{});
}

ElastoonObstacleDef elastoonPlaneDef(ElastoonVec3 normal, double offset) {
    return cDefOf(ObstacleDef::plane(from(normal), offset));
}

ElastoonResult elastoonObstacleCreate(ElastoonWorld world, const ElastoonObstacleDef* def,
                                      ElastoonObstacle* out_obstacle) {
    return guarded([&] {
        HeldWorld* held = find(world);
        if (held == nullptr) {
            return badId("world");
        }
        if (def == nullptr || out_obstacle == nullptr) {
            return nullPointer("def and out_obstacle");
        }
        ObstacleDef obstacle;
        if (const ElastoonResult flaw = fromObstacleDef(*def, obstacle); flaw != kElastoonOk) {
            return flaw;
        }
        const auto added = held->changing().addObstacle(obstacle);
        if (!added) {
            return refusedBy(added.error());
        }
        held->keep(input::AddObstacle{obstacle, added.value()});
        *out_obstacle = toC(added.value(), world);
        return kElastoonOk;
    });
}

ElastoonResult elastoonObstacleDestroy(ElastoonObstacle obstacle) {
    return change(obstacle, input::RemoveObstacle{from(obstacle)});
}

bool elastoonObstacleIsValid(ElastoonObstacle obstacle) {
    return worldOf(obstacle) != nullptr;
}

ElastoonResult elastoonObstacleFrame(ElastoonObstacle obstacle, ElastoonObstacleFrame* out_frame) {
    const HeldWorld* held = worldOf(obstacle);
    if (held == nullptr) {
        return badId("obstacle");
    }
    if (out_frame == nullptr) {
        return nullPointer("out_frame");
    }
    const MovingFrame& frame = held->world.frame(from(obstacle));
    const double now = held->world.time();
    *out_frame = {toC(frame.originAt(now)), toC(frame.orientationAt(now)), toC(frame.velocity),
                  toC(frame.angular_velocity)};
    return kElastoonOk;
}

ElastoonResult elastoonObstacleShape(ElastoonObstacle obstacle, ElastoonShape* out_shape) {
    return guarded([&] {
        const HeldWorld* held = worldOf(obstacle);
        if (held == nullptr) {
            return badId("obstacle");
        }
        if (out_shape == nullptr) {
            return nullPointer("out_shape");
        }
        const ShapePtr& shape = held->world.shape(from(obstacle));
        if (shape == nullptr) {
            *out_shape = {};
            return kElastoonOk;
        }
        return giveId(shape, out_shape);
    });
}

ElastoonResult elastoonObstaclePlaneNormal(ElastoonObstacle obstacle, ElastoonVec3* out_normal) {
    const HeldWorld* held = worldOf(obstacle);
    if (held == nullptr) {
        return badId("obstacle");
    }
    if (out_normal == nullptr) {
        return nullPointer("out_normal");
    }
    if (held->world.shape(from(obstacle)) != nullptr) {
        return refuse(kElastoonRefused, "is a solid, not a plane", "obstacle");
    }
    *out_normal = toC(held->world.planeNormal(from(obstacle)));
    return kElastoonOk;
}

ElastoonResult elastoonObstacleUserData(ElastoonObstacle obstacle, uint64_t* out_user_data) {
    const HeldWorld* held = worldOf(obstacle);
    if (held == nullptr) {
        return badId("obstacle");
    }
    if (out_user_data == nullptr) {
        return nullPointer("out_user_data");
    }
    *out_user_data = held->world.userData(from(obstacle));
    return kElastoonOk;
}

ElastoonResult elastoonObstacleSetMotion(ElastoonObstacle obstacle, ElastoonVec3 velocity,
                                         ElastoonVec3 angular_velocity) {
    return change(obstacle, input::SetObstacleMotion{from(obstacle), from(velocity), from(angular_velocity)});
}

ElastoonResult elastoonObstacleSetPose(ElastoonObstacle obstacle, ElastoonVec3 position, ElastoonQuat rotation) {
    return change(obstacle, input::SetObstaclePose{from(obstacle), from(position), from(rotation)});
}

ElastoonResult elastoonObstacleMove(ElastoonObstacle obstacle, ElastoonVec3 position, ElastoonQuat rotation,
                                    double duration) {
    return change(obstacle, input::MoveObstacle{from(obstacle), from(position), from(rotation), duration});
}
