// What the files of the C interface share: the things that ids name, refusals with their text, and conversions. Private
// to the library. See elastoon.h.
#pragma once

#include "elastoon/elastoon.h"
#include "elastoon/recorder.h"
#include "elastoon/world.h"

#include "c_table.h"

#include <cmath>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace elastoon::c_interface {

/// A world and what the interface keeps of it between two calls that change it.
struct HeldWorld {
    World world;
    ElastoonWorld id{};
    std::vector<BodyId> bodies;
    std::size_t slots = 0;
    std::vector<ElastoonEvent> events;
    std::vector<std::byte> snapshot;
    bool bodies_known = false, events_known = false;
    Recording* recording = nullptr; ///< that takes what is done to the world, if one does

    explicit HeldWorld(World made) : world(std::move(made)) {}
    /// To be called by whatever changes the world: what is kept of it does not hold any more.
    World& changing() {
        events_known = false;
        return world;
    }
    /// Likewise by whatever adds or removes bodies.
    World& changingBodies() {
        bodies_known = false;
        return changing();
    }
    /// Gives the world an input, and keeps it where that is recorded and was not refused.
    Status change(const Input& input);
    /// Keeps an input that the world has taken.
    void keep(const Input& input);
    void step(double dt);
    /// In the order of their slots.
    std::span<const BodyId> knownBodies();
    /// Of bodies, free ones included: as many as the world has matrices.
    std::size_t slotCount();
};

/// Never destroyed: ids may be used until the program's very end.
Table<HeldWorld>& worlds();
Table<ShapePtr>& shapes();

/// Keeps the text for elastoonLastError() and gives the code back.
ElastoonResult refuse(ElastoonResult code, std::string_view message, std::string_view where = {});
ElastoonResult refuse(ElastoonResult code, const Error& error);
ElastoonResult badId(std::string_view kind);
ElastoonResult nullPointer(std::string_view argument);

/// Runs the call; what memory or a host's callback throws does not leave it.
template <class Call>
ElastoonResult guarded(Call&& call) {
#ifdef __cpp_exceptions
    try {
        return call();
    } catch (const std::bad_alloc&) {
        return refuse(kElastoonOutOfMemory, "there is not enough memory");
    } catch (const std::exception& error) {
        return refuse(kElastoonOutOfMemory, error.what());
    } catch (...) {
        return refuse(kElastoonOutOfMemory, "something was thrown");
    }
#else
    return call();
#endif
}

/// A code that comes from the library's own checks of numbers and places.
inline ElastoonResult refusedBy(const Error& error) {
    const bool place = error.message.starts_with("starts ");
    return refuse(place ? kElastoonRefused : kElastoonBadArgument, error);
}
inline ElastoonResult resultOf(const Status& status) {
    return status ? kElastoonOk : refusedBy(status.error());
}

HeldWorld* find(ElastoonWorld id);
const ShapePtr* find(ElastoonShape id);
/// The world of the body, if it has it.
HeldWorld* worldOf(ElastoonBody id);
HeldWorld* worldOf(ElastoonObstacle id);

/// Refused: a world that is being recorded, whose recording would not hold any more.
ElastoonResult checkUnrecorded(const HeldWorld& held);
/// Makes the world the one of the snapshot.
ElastoonResult restore(HeldWorld& held, std::span<const std::byte> snapshot);

/// An id for what was made; refused where there are too many.
ElastoonResult giveId(World world, ElastoonWorld* out_world);
ElastoonResult giveId(ShapePtr shape, ElastoonShape* out_shape);

inline Vec3 from(ElastoonVec3 v) {
    return {v.x, v.y, v.z};
}
inline Quat from(ElastoonQuat q) {
    return {q.w, q.x, q.y, q.z};
}
inline BodyId from(ElastoonBody id) {
    return {id.slot, id.generation};
}
inline ObstacleId from(ElastoonObstacle id) {
    return {id.slot, id.generation};
}
Style from(const ElastoonStyle& style);
inline ElastoonVec3 toC(const Vec3& v) {
    return {v.x, v.y, v.z};
}
inline ElastoonQuat toC(const Quat& q) {
    return {q.x, q.y, q.z, q.w};
}
inline ElastoonPose toC(const Pose& pose) {
    return {toC(pose.position), toC(pose.orientation), pose.stretch};
}
inline ElastoonBody toC(BodyId id, ElastoonWorld world) {
    return {id.slot, id.generation, world};
}
/// The null obstacle names no world either.
inline ElastoonObstacle toC(ObstacleId id, ElastoonWorld world) {
    return id ? ElastoonObstacle{id.slot, id.generation, world} : ElastoonObstacle{};
}
ElastoonStyle toC(const Style& style);
ElastoonEvent toC(const Event& event, ElastoonWorld world);

/// An error where a choice of the style is no value of its enum: what the library itself cannot see.
ElastoonResult checkChoices(const ElastoonStyle& style);
/// The definition in the library's words.
ElastoonResult fromDef(const ElastoonBodyDef& def, BodyDef& out_def);

/// Writes a list by the rule of elastoon.h: item(i) for each of `count`.
template <class Item, class Make>
ElastoonResult writeList(std::size_t count, Item* out_items, std::size_t capacity, std::size_t* out_count,
                         Make&& item) {
    if (out_count == nullptr) {
        return nullPointer("the count");
    }
    *out_count = count;
    if (out_items == nullptr) {
        return capacity == 0 ? kElastoonOk : nullPointer("the array");
    }
    if (capacity < count) {
        return refuse(kElastoonTooSmall, "the array is too small; the count tells what is needed");
    }
    for (std::size_t i = 0; i < count; ++i) {
        out_items[i] = item(i);
    }
    return kElastoonOk;
}

} // namespace elastoon::c_interface
