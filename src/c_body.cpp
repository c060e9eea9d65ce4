// The C interface to bodies. See elastoon.h.
#include "c_interface.h"

#include "check_input.h"

#include <algorithm>

using namespace elastoon;
using namespace elastoon::c_interface;

namespace {

/// Asks the body's world, where there is such a body and a place for the answer.
template <class Answer, class Ask>
ElastoonResult answer(ElastoonBody body, Answer* out_answer, Ask&& ask) {
    return guarded([&] {
        const HeldWorld* held = worldOf(body);
        if (held == nullptr) {
            return badId("body");
        }
        if (out_answer == nullptr) {
            return nullPointer("the answer's place");
        }
        *out_answer = ask(held->world, from(body));
        return kElastoonOk;
    });
}

ElastoonResult change(ElastoonBody body, const Input& input) {
    return guarded([&] {
        HeldWorld* held = worldOf(body);
        return held == nullptr ? badId("body") : resultOf(held->change(input));
    });
}

bool goodDelay(double delay) {
    return delay >= 0.0 && delay <= kMostStep;
}

} // namespace

ElastoonBodyDef elastoonDefaultBodyDef(void) {
    const BodyDef def;
    return {{}, toC(def.style), toC(def.position), toC(def.velocity), toC(def.rotation), def.user_data};
}

ElastoonResult elastoonBodyCreate(ElastoonWorld world, const ElastoonBodyDef* def, ElastoonBody* out_body) {
    return guarded([&] {
        HeldWorld* held = find(world);
        if (held == nullptr) {
            return badId("world");
        }
        if (def == nullptr || out_body == nullptr) {
            return nullPointer("def and out_body");
        }
        BodyDef body;
        if (const ElastoonResult flaw = fromDef(*def, body); flaw != kElastoonOk) {
            return flaw;
        }
        const auto added = held->changingBodies().addBody(body);
        if (!added) {
            return refusedBy(added.error());
        }
        held->keep(input::AddBody{body, added.value()});
        *out_body = toC(added.value(), world);
        return kElastoonOk;
    });
}

ElastoonResult elastoonBodyDestroy(ElastoonBody body) {
    return change(body, input::RemoveBody{from(body)});
}

bool elastoonBodyIsValid(ElastoonBody body) {
    return worldOf(body) != nullptr;
}

ElastoonResult elastoonBodyPose(ElastoonBody body, ElastoonPose* out_pose) {
    return answer(body, out_pose, [](const World& world, BodyId id) { return toC(world.pose(id)); });
}

ElastoonResult elastoonBodyVelocity(ElastoonBody body, ElastoonVec3* out_velocity) {
    return answer(body, out_velocity, [](const World& world, BodyId id) { return toC(world.velocity(id)); });
}

ElastoonResult elastoonBodyPhase(ElastoonBody body, ElastoonPhaseInfo* out_phase) {
    return answer(body, out_phase, [&](const World& world, BodyId id) {
        const Phase& phase = world.phase(id);
        return ElastoonPhaseInfo{static_cast<std::int32_t>(phase.motion.index()), phase.start, phase.end,
                                 toC(phase.obstacle, body.world)};
    });
}

ElastoonResult elastoonBodyStyle(ElastoonBody body, ElastoonStyle* out_style) {
    return answer(body, out_style, [](const World& world, BodyId id) { return toC(world.style(id)); });
}

ElastoonResult elastoonBodyUserData(ElastoonBody body, uint64_t* out_user_data) {
    return answer(body, out_user_data, [](const World& world, BodyId id) { return world.userData(id); });
}

ElastoonResult elastoonBodyShape(ElastoonBody body, ElastoonShape* out_shape) {
    return guarded([&] {
        const HeldWorld* held = worldOf(body);
        if (held == nullptr) {
            return badId("body");
        }
        return out_shape == nullptr ? nullPointer("out_shape") : giveId(held->world.shape(from(body)), out_shape);
    });
}

ElastoonResult elastoonBodySetPosition(ElastoonBody body, ElastoonVec3 position) {
    return change(body, input::SetPosition{from(body), from(position)});
}

ElastoonResult elastoonBodySetVelocity(ElastoonBody body, ElastoonVec3 velocity) {
    return change(body, input::SetVelocity{from(body), from(velocity)});
}

ElastoonResult elastoonBodySteerImpact(ElastoonBody body, ElastoonVec3 velocity) {
    return change(body, input::SteerImpact{from(body), from(velocity)});
}

ElastoonResult elastoonBodySetStyle(ElastoonBody body, const ElastoonStyle* style) {
    if (style == nullptr) {
        return nullPointer("style");
    }
    if (const ElastoonResult flaw = checkChoices(*style); flaw != kElastoonOk) {
        return flaw;
    }
    return change(body, input::SetStyle{from(body), from(*style)});
}

ElastoonResult elastoonBodyPredictPoses(ElastoonBody body, const double* delays, size_t count,
                                        ElastoonPose* out_poses) {
    return guarded([&] {
        const HeldWorld* held = worldOf(body);
        if (held == nullptr) {
            return badId("body");
        }
        if (count == 0) {
            return kElastoonOk;
        }
        if (delays == nullptr || out_poses == nullptr) {
            return nullPointer("delays and out_poses");
        }
        if (!std::all_of(delays, delays + count, goodDelay)) {
            return refuse(kElastoonBadArgument, "must be from 0 to 1e6 s", "delays");
        }
        const World& world = held->world;
        const Prediction prediction = world.predict(from(body), *std::max_element(delays, delays + count));
        const Shape& shape = *world.shape(from(body));
        for (std::size_t i = 0; i < count; ++i) {
            out_poses[i] = toC(prediction.poseAt(shape, world.time() + delays[i]));
        }
        return kElastoonOk;
    });
}

ElastoonResult elastoonBodyPredictEvents(ElastoonBody body, double horizon, ElastoonEvent* out_events, size_t capacity,
                                         size_t* out_count) {
    return guarded([&] {
        const HeldWorld* held = worldOf(body);
        if (held == nullptr) {
            return badId("body");
        }
        if (!goodDelay(horizon)) {
            return refuse(kElastoonBadArgument, "must be from 0 to 1e6 s", "horizon");
        }
        const Prediction prediction = held->world.predict(from(body), horizon);
        return writeList(prediction.events.size(), out_events, capacity, out_count,
                         [&](std::size_t i) { return toC(prediction.events[i], body.world); });
    });
}
