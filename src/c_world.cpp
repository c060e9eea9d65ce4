// The C interface to worlds: making, stepping, asking, saving. The bulk calls are in c_bulk.cpp. See elastoon.h.
#include "c_interface.h"

#include "check_input.h"

#include <cstring>
#include <memory>

using namespace elastoon;
using namespace elastoon::c_interface;

namespace {

ParallelFor parallelForOf(const ElastoonWorldDef& def) {
    if (def.parallel_for == nullptr) {
        return {};
    }
    return [run = def.parallel_for, context = def.parallel_context](
               std::size_t count, const std::function<void(std::size_t, std::size_t)>& body) {
        const ElastoonRangeFunction part = [](void* part_context, std::size_t begin, std::size_t end) {
            (*static_cast<const std::function<void(std::size_t, std::size_t)>*>(part_context))(begin, end);
        };
        run(context, count, part, const_cast<void*>(static_cast<const void*>(&body)));
    };
}

} // namespace

ElastoonResult c_interface::restore(HeldWorld& held, std::span<const std::byte> snapshot) {
    std::vector<ShapePtr> known;
    shapes().forEach([&](const ShapePtr& shape) { known.push_back(shape); });
    const Status status = held.changingBodies().restore(snapshot, known);
    return status ? kElastoonOk : refuse(kElastoonBadData, status.error());
}

ElastoonWorldDef elastoonDefaultWorldDef(void) {
    return {toC(WorldDef{}.gravity), nullptr, nullptr};
}

ElastoonResult elastoonWorldCreate(const ElastoonWorldDef* def, ElastoonWorld* out_world) {
    return guarded([&] {
        if (def == nullptr || out_world == nullptr) {
            return nullPointer("def and out_world");
        }
        auto made = World::create({from(def->gravity), parallelForOf(*def)});
        return made ? giveId(std::move(made).value(), out_world) : refusedBy(made.error());
    });
}

ElastoonResult elastoonWorldDestroy(ElastoonWorld world) {
    return worlds().remove({world.slot, world.generation}) != nullptr ? kElastoonOk : badId("world");
}

bool elastoonWorldIsValid(ElastoonWorld world) {
    return find(world) != nullptr;
}

ElastoonResult elastoonWorldStep(ElastoonWorld world, double dt) {
    return guarded([&] {
        HeldWorld* held = find(world);
        if (held == nullptr) {
            return badId("world");
        }
        if (!(dt >= 0.0 && dt <= kMostStep)) {
            return refuse(kElastoonBadArgument, "must be from 0 to 1e6 s", "dt");
        }
        held->step(dt);
        return kElastoonOk;
    });
}

ElastoonResult elastoonWorldTime(ElastoonWorld world, double* out_time) {
    const HeldWorld* held = find(world);
    if (held == nullptr) {
        return badId("world");
    }
    if (out_time == nullptr) {
        return nullPointer("out_time");
    }
    *out_time = held->world.time();
    return kElastoonOk;
}

ElastoonResult elastoonWorldGravity(ElastoonWorld world, ElastoonVec3* out_gravity) {
    const HeldWorld* held = find(world);
    if (held == nullptr) {
        return badId("world");
    }
    if (out_gravity == nullptr) {
        return nullPointer("out_gravity");
    }
    *out_gravity = toC(held->world.gravity());
    return kElastoonOk;
}

ElastoonResult elastoonWorldSetGravity(ElastoonWorld world, ElastoonVec3 gravity) {
    return guarded([&] {
        HeldWorld* held = find(world);
        return held == nullptr ? badId("world") : resultOf(held->change(input::SetGravity{from(gravity)}));
    });
}

ElastoonResult elastoonWorldStateHash(ElastoonWorld world, uint64_t* out_hash) {
    const HeldWorld* held = find(world);
    if (held == nullptr) {
        return badId("world");
    }
    if (out_hash == nullptr) {
        return nullPointer("out_hash");
    }
    *out_hash = held->world.stateHash();
    return kElastoonOk;
}

ElastoonResult elastoonWorldBodies(ElastoonWorld world, ElastoonBody* out_bodies, size_t capacity, size_t* out_count) {
    return guarded([&] {
        HeldWorld* held = find(world);
        if (held == nullptr) {
            return badId("world");
        }
        const std::span<const BodyId> bodies = held->knownBodies();
        return writeList(bodies.size(), out_bodies, capacity, out_count,
                         [&](std::size_t i) { return toC(bodies[i], world); });
    });
}

ElastoonResult elastoonWorldObstacles(ElastoonWorld world, ElastoonObstacle* out_obstacles, size_t capacity,
                                      size_t* out_count) {
    return guarded([&] {
        const HeldWorld* held = find(world);
        if (held == nullptr) {
            return badId("world");
        }
        const std::vector<ObstacleId> obstacles = held->world.obstacles();
        return writeList(obstacles.size(), out_obstacles, capacity, out_count,
                         [&](std::size_t i) { return toC(obstacles[i], world); });
    });
}

ElastoonResult elastoonWorldOverlap(ElastoonWorld world, const ElastoonBodyDef* def, ElastoonOverlap* out_overlap) {
    return guarded([&] {
        const HeldWorld* held = find(world);
        if (held == nullptr) {
            return badId("world");
        }
        if (def == nullptr || out_overlap == nullptr) {
            return nullPointer("def and out_overlap");
        }
        BodyDef body;
        if (const ElastoonResult flaw = fromDef(*def, body); flaw != kElastoonOk) {
            return flaw;
        }
        if (const auto error = checkBodyDef(body)) {
            return refuse(kElastoonBadArgument, *error);
        }
        const auto overlap = held->world.overlapOf(body).value_or(Overlap{});
        *out_overlap = {toC(overlap.obstacle, world), overlap.depth, toC(overlap.normal)};
        return kElastoonOk;
    });
}

ElastoonResult elastoonWorldSnapshot(ElastoonWorld world, bool include_shapes, void* out_bytes, size_t capacity,
                                     size_t* out_size) {
    return guarded([&] {
        HeldWorld* held = find(world);
        if (held == nullptr) {
            return badId("world");
        }
        held->world.snapshotInto(held->snapshot, {include_shapes});
        return writeList(held->snapshot.size(), static_cast<std::byte*>(out_bytes), capacity, out_size,
                         [&](std::size_t i) { return held->snapshot[i]; });
    });
}

ElastoonResult elastoonWorldRestore(ElastoonWorld world, const void* bytes, size_t size) {
    return guarded([&] {
        HeldWorld* held = find(world);
        if (held == nullptr) {
            return badId("world");
        }
        if (bytes == nullptr) {
            return nullPointer("bytes");
        }
        const ElastoonResult recorded = checkUnrecorded(*held);
        return recorded == kElastoonOk ? restore(*held, {static_cast<const std::byte*>(bytes), size}) : recorded;
    });
}
