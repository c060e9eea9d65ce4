// See matrix_table.h. The lanes do what unpushedPose() and linearOf() do, in the same order; a test holds the two
// equal.
#include "matrix_table.h"

#include "flight.h"
#include "prefetch.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace elastoon {

namespace {

constexpr std::size_t kLanes = FlightLanes::kCount;
using Columns = std::array<std::array<float, kLanes>, MatrixTable::kFloats>;

void setLane(FlightLanes& lanes, std::size_t lane, const Phase& phase) {
    const auto& flight = phase.get<Flight>();
    const bool turns = flight.rule != AxisRule::Fixed && flight.speed_across > 0.0;
    lanes.start[lane] = phase.start;
    lanes.climb[lane] = flight.climb;
    lanes.stretch_rate[lane] = flight.stretch_rate;
    lanes.max_stretch[lane] = flight.max_stretch;
    // Negative: the axis is laid along the velocity. One that does not turn is a reversal straight up.
    lanes.across[lane] = turns ? flight.speed_across : 0.0;
    lanes.reversal_speed[lane] = !turns ? 1.0 : flight.rule == AxisRule::Reversal ? flight.reversal_speed : -1.0;
    const Vec3 axis = turns ? flight.turn_axis : Vec3(0.0);
    const auto put = [lane](std::array<FlightLanes::Row, 3>& rows, const Vec3& from) {
        rows[0][lane] = from.x;
        rows[1][lane] = from.y;
        rows[2][lane] = from.z;
    };
    put(lanes.position, flight.position);
    put(lanes.velocity, flight.velocity);
    put(lanes.axis, axis);
    lanes.orientation[0][lane] = flight.orientation.w;
    lanes.orientation[1][lane] = flight.orientation.x;
    lanes.orientation[2][lane] = flight.orientation.y;
    lanes.orientation[3][lane] = flight.orientation.z;
}

[[gnu::always_inline]] inline void poseLanesHere(const FlightLanes& in, const Vec3& gravity, double t, Columns& out) {
    const double gx = gravity.x, gy = gravity.y, gz = gravity.z;
    const double pull = glm::length(gravity);
    for (std::size_t i = 0; i < kLanes; ++i) {
        const double elapsed = t - in.start[i];
        const double half = 0.5 * elapsed;
        const double vx = in.velocity[0][i], vy = in.velocity[1][i], vz = in.velocity[2][i];
        const double wx = vx + gx * elapsed, wy = vy + gy * elapsed, wz = vz + gz * elapsed;
        const double scaled = in.stretch_rate[i] * std::sqrt(wx * wx + wy * wy + wz * wz);
        const double stretch = (scaled * in.max_stretch[i] + 1.0) / (scaled + 1.0);

        // The heading at the start and now, by its parts up and across.
        const double across = in.across[i];
        const double e = in.reversal_speed[i];
        const double climb_0 = in.climb[i];
        const double climb_t = climb_0 - pull * elapsed;
        const bool along_velocity = e < 0.0;
        const double raw_up_0 = along_velocity ? climb_0 : climb_0 * climb_0 + e * e;
        const double raw_across_0 = along_velocity ? across : climb_0 * across;
        const double raw_up_t = along_velocity ? climb_t : climb_t * climb_t + e * e;
        const double raw_across_t = along_velocity ? across : climb_t * across;
        const double length_0 = std::sqrt(raw_up_0 * raw_up_0 + raw_across_0 * raw_across_0);
        const double length_t = std::sqrt(raw_up_t * raw_up_t + raw_across_t * raw_across_t);
        const double up_0 = raw_up_0 / length_0, across_0 = raw_across_0 / length_0;
        const double up_t = raw_up_t / length_t, across_t = raw_across_t / length_t;

        // The turn from the one to the other.
        const double cosine = up_0 * up_t + across_0 * across_t;
        const double sine = up_0 * across_t - across_0 * up_t;
        const double larger = std::sqrt(0.5 * (1.0 + std::fabs(cosine)));
        const double smaller = 0.5 * sine / larger;
        const bool acute = cosine >= 0.0;
        const double half_sine = acute ? smaller : (sine < 0.0 ? -larger : larger);
        const double half_cosine = acute ? larger : std::fabs(smaller);
        const double pw = half_cosine;
        const double px = in.axis[0][i] * half_sine, py = in.axis[1][i] * half_sine, pz = in.axis[2][i] * half_sine;
        const double ow = in.orientation[0][i], ox = in.orientation[1][i];
        const double oy = in.orientation[2][i], oz = in.orientation[3][i];
        const double w = pw * ow - px * ox - py * oy - pz * oz;
        const double x = pw * ox + px * ow + py * oz - pz * oy;
        const double y = pw * oy + py * ow + pz * ox - px * oz;
        const double z = pw * oz + pz * ow + px * oy - py * ox;

        const double thin = 1.0 / std::sqrt(stretch);
        const double xx = x * x, yy = y * y, zz = z * z, xz = x * z, xy = x * y, yz = y * z;
        const double wqx = w * x, wqy = w * y, wqz = w * z;
        out[0][i] = static_cast<float>((1.0 - 2.0 * (yy + zz)) * stretch);
        out[1][i] = static_cast<float>(2.0 * (xy + wqz) * stretch);
        out[2][i] = static_cast<float>(2.0 * (xz - wqy) * stretch);
        out[3][i] = static_cast<float>(2.0 * (xy - wqz) * thin);
        out[4][i] = static_cast<float>((1.0 - 2.0 * (xx + zz)) * thin);
        out[5][i] = static_cast<float>(2.0 * (yz + wqx) * thin);
        out[6][i] = static_cast<float>(2.0 * (xz + wqy) * thin);
        out[7][i] = static_cast<float>(2.0 * (yz - wqx) * thin);
        out[8][i] = static_cast<float>((1.0 - 2.0 * (xx + yy)) * thin);
        out[9][i] = static_cast<float>(in.position[0][i] + (vx + gx * half) * elapsed);
        out[10][i] = static_cast<float>(in.position[1][i] + (vy + gy * half) * elapsed);
        out[11][i] = static_cast<float>(in.position[2][i] + (vz + gz * half) * elapsed);
    }
}

#if defined(__x86_64__)
// Wider registers where there are some; no fused operations, so that the bits are the same.
[[gnu::target("avx2")]] void poseLanesWide(const FlightLanes& in, const Vec3& gravity, double t, Columns& out) {
    poseLanesHere(in, gravity, t, out);
}

void poseLanes(const FlightLanes& in, const Vec3& gravity, double t, Columns& out) {
    static const bool kWide = __builtin_cpu_supports("avx2");
    kWide ? poseLanesWide(in, gravity, t, out) : poseLanesHere(in, gravity, t, out);
}
#else
void poseLanes(const FlightLanes& in, const Vec3& gravity, double t, Columns& out) {
    poseLanesHere(in, gravity, t, out);
}
#endif

/// Sixteen whole matrices, one after another: four by four of the columns turned at a time.
void writeAll(const Columns& columns, float* out) {
    using Four [[gnu::vector_size(16)]] = float;
    constexpr std::size_t kFour = 4;
    for (std::size_t k = 0; k < MatrixTable::kFloats; k += kFour) {
        for (std::size_t i = 0; i < kLanes; i += kFour) {
            Four a, b, c, d;
            std::memcpy(&a, &columns[k][i], sizeof a);
            std::memcpy(&b, &columns[k + 1][i], sizeof b);
            std::memcpy(&c, &columns[k + 2][i], sizeof c);
            std::memcpy(&d, &columns[k + 3][i], sizeof d);
            const Four ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5);
            const Four ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
            const Four cd_low = __builtin_shufflevector(c, d, 0, 4, 1, 5);
            const Four cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
            const std::array<Four, kFour> rows{__builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5),
                                               __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7),
                                               __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5),
                                               __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7)};
            for (std::size_t row = 0; row < kFour; ++row) {
                std::memcpy(out + MatrixTable::kFloats * (i + row) + k, &rows[row], sizeof(Four));
            }
        }
    }
}

/// One of them.
void writeOne(const Columns& columns, std::size_t lane, float* out) {
    for (std::size_t k = 0; k < MatrixTable::kFloats; ++k) {
        out[k] = columns[k][lane];
    }
}

} // namespace

void MatrixTable::writePose(std::size_t slot, const BodySlot& body, double t) {
    const Pose pose = poseAt(body.phase, *body.shape, t);
    const Mat3 linear = linearOf(pose);
    float* out = &matrices_[kFloats * slot];
    for (int column = 0; column < 4; ++column) {
        const Vec3& from = column < 3 ? linear[column] : pose.position;
        for (int row = 0; row < 3; ++row) {
            *out++ = static_cast<float>(from[row]);
        }
    }
}

void MatrixTable::take(std::size_t slot, const BodySlot& body, double t) {
    constexpr double kForEver = std::numeric_limits<double>::infinity();
    Block& block = blocks_[slot / kLanes];
    const std::size_t lane = slot % kLanes;
    const auto put = [&](Kind kind, double posed_until) {
        block.kinds[lane] = kind;
        block.posed_until[lane] = posed_until;
        block.any_posed_until = *std::max_element(block.posed_until.begin(), block.posed_until.end());
    };
    if (!body.used) {
        put(Kind::Written, -kForEver);
        std::fill_n(&matrices_[kFloats * slot], kFloats, 0.0F);
        return;
    }
    put(Kind::Posed, kForEver);
    if (const auto* flight = body.phase.as<Flight>(); flight != nullptr && flight->gravity == gravity_) {
        constexpr double kAfter = 1e-9; ///< s, past all doubt of rounding
        setLane(block.lanes, lane, body.phase);
        const Phase& phase = body.phase;
        put(Kind::Lane, std::max(phase.clear_of.empty() ? phase.start : phase.free_from,
                                 flight->ease->span > 0.0 ? phase.start + flight->ease->span + kAfter : phase.start));
    } else if (const auto* rest = body.phase.as<Rest>()) {
        if (!rest->surface.frame.moves() && body.phase.clear_of.empty()) {
            writePose(slot, body, t);
            put(Kind::Written, -kForEver);
        }
    }
}

void MatrixTable::takeChanges(double t, const std::vector<BodySlot>& bodies, const Vec3& gravity) {
    in_use_ = true;
    all_changed_ = all_changed_ || gravity != gravity_;
    gravity_ = gravity;
    if (blocks_.size() * kLanes < bodies.size()) {
        blocks_.resize((bodies.size() + kLanes - 1) / kLanes);
    }
    if (matrices_.size() != kFloats * bodies.size()) {
        all_changed_ = all_changed_ || matrices_.size() > kFloats * bodies.size();
        matrices_.resize(kFloats * bodies.size());
    }
    if (all_changed_ || changed_.size() > bodies.size()) {
        blocks_.assign((bodies.size() + kLanes - 1) / kLanes, Block{});
        for (std::size_t slot = 0; slot < bodies.size(); ++slot) {
            take(slot, bodies[slot], t);
        }
    } else {
        for (const std::size_t slot : changed_) {
            take(slot, bodies[slot], t);
        }
    }
    changed_.clear();
    all_changed_ = false;
}

/// Calls what(slot) for those of the block whose pose is asked for, one by one.
template <class What>
void MatrixTable::forPosed(std::size_t index, double t, What&& what) const {
    if (index >= blocks_.size() || t >= blocks_[index].any_posed_until) {
        return;
    }
    for (std::size_t i = 0; i < kLanes; ++i) {
        if (t < blocks_[index].posed_until[i]) {
            what(index * kLanes + i);
        }
    }
}

void MatrixTable::writePosed(std::size_t index, double t, const std::vector<BodySlot>& bodies) {
    forPosed(index + 4, t, [&](std::size_t slot) { prefetchSlot(bodies[slot]); });
    forPosed(index + 2, t, [&](std::size_t slot) { prefetchRest(bodies[slot]); });
    forPosed(index, t, [&](std::size_t slot) { writePose(slot, bodies[slot], t); });
}

void MatrixTable::writeLanes(std::size_t index, double t, std::size_t bodies) {
    const Block& block = blocks_[index];
    const std::size_t first = index * kLanes;
    const std::size_t count = std::min(kLanes, bodies - first);
    std::array<bool, kLanes> by_lane{};
    std::size_t flights = 0;
    for (std::size_t i = 0; i < count; ++i) {
        by_lane[i] = block.kinds[i] == Kind::Lane && t >= block.posed_until[i];
        flights += by_lane[i] ? 1 : 0;
    }
    if (flights == 0) {
        return;
    }
    Columns columns;
    poseLanes(block.lanes, gravity_, t, columns);
    float* out = &matrices_[kFloats * first];
    if (flights == kLanes) {
        writeAll(columns, out);
        return;
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (by_lane[i]) {
            writeOne(columns, i, out + kFloats * i);
        }
    }
}

std::span<const float> MatrixTable::at(double t, const std::vector<BodySlot>& bodies, const Vec3& gravity,
                                       const ParallelFor& parallel_for) {
    takeChanges(t, bodies, gravity);
    // Batches of one kind: what poses are worked out with stays in the nearest cache, and the matrices in the next.
    constexpr std::size_t kBatch = 64;
    const auto writeBlocks = [&](std::size_t begin, std::size_t end) {
        for (std::size_t first = begin; first < end; first += kBatch) {
            const std::size_t last = std::min(end, first + kBatch);
            for (std::size_t i = first; i < last; ++i) {
                writePosed(i, t, bodies);
            }
            for (std::size_t i = first; i < last; ++i) {
                writeLanes(i, t, bodies.size());
            }
        }
    };
    if (parallel_for) {
        parallel_for(blocks_.size(), writeBlocks);
    } else {
        writeBlocks(0, blocks_.size());
    }
    return matrices_;
}

} // namespace elastoon
