// The C interface's bulk calls: all matrices, poses and events of a world at once. See elastoon.h.
#include "c_interface.h"

#include <algorithm>
#include <array>

using namespace elastoon;
using namespace elastoon::c_interface;

namespace {

/// 12 numbers a slot, zero where it is free. `out` has room for them.
void writeMatrices(HeldWorld& held, float* out) {
    const std::span<const float> matrices = held.world.matrices();
    std::copy(matrices.begin(), matrices.end(), out);
}

/// Likewise, from the poses: the library's own are floats.
void writeMatrices(HeldWorld& held, double* out) {
    std::fill_n(out, 12 * held.slotCount(), 0.0);
    for (const BodyId body : held.knownBodies()) {
        const Pose pose = held.world.pose(body);
        const Mat3 linear = linearOf(pose);
        double* matrix = out + std::size_t{12} * (body.slot - 1);
        for (int column = 0; column < 4; ++column) {
            const Vec3& from_column = column < 3 ? linear[column] : pose.position;
            for (int row = 0; row < 3; ++row) {
                *matrix++ = from_column[row];
            }
        }
    }
}

/// The columns of R S^-1: those of R S over their squared lengths. In place of 12 numbers 9 are written.
template <class Number>
void writeNormalMatrices(HeldWorld& held, Number* out) {
    std::vector<double> matrices(12 * held.slotCount());
    writeMatrices(held, matrices.data());
    for (std::size_t slot = 0; slot < held.slotCount(); ++slot) {
        for (std::size_t column = 0; column < 3; ++column) {
            const double* from_column = matrices.data() + 12 * slot + 3 * column;
            const double square =
                from_column[0] * from_column[0] + from_column[1] * from_column[1] + from_column[2] * from_column[2];
            for (std::size_t row = 0; row < 3; ++row) {
                out[9 * slot + 3 * column + row] =
                    square > 0.0 ? static_cast<Number>(from_column[row] / square) : Number{0};
            }
        }
    }
}

/// Looks at the array by the rule of elastoon.h, in items of `numbers` each, and has it filled.
template <class Number, class Fill>
ElastoonResult writeBulk(ElastoonWorld world, Number* out_items, std::size_t capacity, std::size_t* out_count,
                         Fill&& fill) {
    return guarded([&] {
        HeldWorld* held = find(world);
        if (held == nullptr) {
            return badId("world");
        }
        if (out_count == nullptr) {
            return nullPointer("the count");
        }
        const std::size_t count = held->slotCount();
        *out_count = count;
        if (out_items == nullptr) {
            return capacity == 0 ? kElastoonOk : nullPointer("the array");
        }
        if (capacity < count) {
            return refuse(kElastoonTooSmall, "the array is too small; the count tells what is needed");
        }
        fill(*held, out_items);
        return kElastoonOk;
    });
}

} // namespace

ElastoonResult elastoonWorldMatrices(ElastoonWorld world, float* out_matrices, size_t capacity, size_t* out_count) {
    return writeBulk(world, out_matrices, capacity, out_count,
                     [](HeldWorld& held, float* out) { writeMatrices(held, out); });
}

ElastoonResult elastoonWorldMatricesDouble(ElastoonWorld world, double* out_matrices, size_t capacity,
                                           size_t* out_count) {
    return writeBulk(world, out_matrices, capacity, out_count,
                     [](HeldWorld& held, double* out) { writeMatrices(held, out); });
}

ElastoonResult elastoonWorldNormalMatrices(ElastoonWorld world, float* out_matrices, size_t capacity,
                                           size_t* out_count) {
    return writeBulk(world, out_matrices, capacity, out_count, writeNormalMatrices<float>);
}

ElastoonResult elastoonWorldNormalMatricesDouble(ElastoonWorld world, double* out_matrices, size_t capacity,
                                                 size_t* out_count) {
    return writeBulk(world, out_matrices, capacity, out_count, writeNormalMatrices<double>);
}

ElastoonResult elastoonWorldMatricesView(ElastoonWorld world, const float** out_matrices, size_t* out_count) {
    return guarded([&] {
        HeldWorld* held = find(world);
        if (held == nullptr) {
            return badId("world");
        }
        if (out_matrices == nullptr || out_count == nullptr) {
            return nullPointer("out_matrices and out_count");
        }
        const std::span<const float> matrices = held->world.matrices();
        *out_matrices = matrices.data();
        *out_count = matrices.size() / 12;
        return kElastoonOk;
    });
}

ElastoonResult elastoonWorldPoses(ElastoonWorld world, ElastoonPose* out_poses, size_t capacity, size_t* out_count) {
    return writeBulk(world, out_poses, capacity, out_count, [](HeldWorld& held, ElastoonPose* out) {
        std::fill_n(out, held.slotCount(), toC(Pose{}));
        for (const BodyId body : held.knownBodies()) {
            out[body.slot - 1] = toC(held.world.pose(body));
        }
    });
}

ElastoonResult elastoonWorldEvents(ElastoonWorld world, const ElastoonEvent** out_events, size_t* out_count) {
    return guarded([&] {
        HeldWorld* held = find(world);
        if (held == nullptr) {
            return badId("world");
        }
        if (out_events == nullptr || out_count == nullptr) {
            return nullPointer("out_events and out_count");
        }
        if (!held->events_known) {
            held->events.clear();
            for (const Event& event : held->world.events()) {
                held->events.push_back(toC(event, world));
            }
            held->events_known = true;
        }
        *out_events = held->events.data();
        *out_count = held->events.size();
        return kElastoonOk;
    });
}

const char* elastoonEventName(int32_t type) {
    const bool known = type >= kElastoonImpact && type <= kElastoonSqueeze;
    return known ? nameOf(static_cast<EventType>(type)).data() : "";
}
