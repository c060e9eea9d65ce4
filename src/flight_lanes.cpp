// See flight_lanes.h.
#include "flight_lanes.h"

#include "flight.h"

#include <cmath>

namespace elastoon {

Falling::Falling(const Vec3& all) {
    const double length = glm::length(all);
    const bool falls = length > kLeastPull;
    pull = falls ? length : 0.0;
    gravity = falls ? all : Vec3(0.0);
    up = falls ? -all / pull : Vec3(0.0);
    turns = falls ? 1.0 : 0.0;
}

void FlightLanes::set(std::size_t lane, double began, const Flight& flight) {
    Eight& eight = eights[lane / kTogether];
    const std::size_t i = lane % kTogether;
    eight.start[i] = began;
    eight.reversal_speed[i] = flight.reversal_speed;
    eight.max_stretch[i] = flight.max_stretch;
    eight.stretch_rate[i] = flight.stretch_rate;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        eight.position[axis][i] = flight.position[static_cast<int>(axis)];
        eight.velocity[axis][i] = flight.velocity[static_cast<int>(axis)];
    }
    eight.orientation[0][i] = flight.orientation.w;
    eight.orientation[1][i] = flight.orientation.x;
    eight.orientation[2][i] = flight.orientation.y;
    eight.orientation[3][i] = flight.orientation.z;
}

void FlightLanes::get(std::size_t lane, const Vec3& gravity, Flight& flight) const {
    const Eight& eight = eights[lane / kTogether];
    const std::size_t i = lane % kTogether;
    flight.position = {eight.position[0][i], eight.position[1][i], eight.position[2][i]};
    flight.velocity = {eight.velocity[0][i], eight.velocity[1][i], eight.velocity[2][i]};
    flight.gravity = gravity;
    flight.orientation = {eight.orientation[0][i], eight.orientation[1][i], eight.orientation[2][i],
                          eight.orientation[3][i]};
    flight.reversal_speed = eight.reversal_speed[i];
    flight.max_stretch = eight.max_stretch[i];
    flight.stretch_rate = eight.stretch_rate[i];
    completeFlight(flight);
}

namespace {

// Four lanes at a time, so that their floats fill a register. gcc does so by itself, and where registers hold four
// doubles clang does.
#if defined(__wasm__)
#define ELASTOON_LANE_LOOP _Pragma("clang loop vectorize_width(4) interleave_count(1)")
#else
#define ELASTOON_LANE_LOOP
#endif

[[gnu::always_inline]] inline void poseEight(const FlightLanes::Eight& in, const Falling& falling, double t,
                                             std::size_t first, Columns& out) {
    const double pull = falling.pull;
    const Vec3 g = falling.gravity;
    const Vec3 up = falling.up;
    // What does not turn is a reversal straight up.
    const double turns = falling.turns;
    ELASTOON_LANE_LOOP
    for (std::size_t i = 0; i < FlightLanes::kTogether; ++i) {
        const double elapsed = t - in.start[i];
        const double half = 0.5 * elapsed;
        const double vx = in.velocity[0][i], vy = in.velocity[1][i], vz = in.velocity[2][i];

        // completeFlight(): the plane of the parabola.
        const double climb_0 = vx * up.x + vy * up.y + vz * up.z;
        const double sx = vx - up.x * climb_0, sy = vy - up.y * climb_0, sz = vz - up.z * climb_0;
        const double square = sx * sx + sy * sy + sz * sz;
        const bool is_none = square <= kNothingAcross * (climb_0 * climb_0);
        const double root = std::sqrt(square);
        const double across = is_none ? 0.0 : root;
        const double inverse_across = 1.0 / (is_none ? 1.0 : root);
        const double hx = sx * inverse_across, hy = sy * inverse_across, hz = sz * inverse_across;
        const double ax = up.y * hz - hy * up.z, ay = up.z * hx - hz * up.x, az = up.x * hy - hx * up.y;

        // stretchAt().
        const double climb = climb_0 - pull * elapsed;
        const double scaled = in.stretch_rate[i] * std::sqrt(climb * climb + across * across);
        const double stretch = (scaled * in.max_stretch[i] + 1.0) / (scaled + 1.0);

        // turnFromUp().
        const double e = in.reversal_speed[i] * turns + (1.0 - turns);
        const double turning = across * turns;
        const bool reverses = turning < e;
        const double raw_up = reverses ? climb * climb + e * e : climb;
        const double raw_across = reverses ? climb * turning : turning;
        const double length = std::sqrt(raw_up * raw_up + raw_across * raw_across);
        const double sum = length + std::fabs(raw_up);
        const double inverse = 1.0 / std::sqrt(2.0 * length * sum);
        const double larger = sum * inverse;
        const double smaller = raw_across * inverse;
        const bool acute = raw_up >= 0.0;
        const double half_sine = acute ? smaller : larger;
        const double half_cosine = acute ? larger : smaller;
        const LaneTurn turn{half_cosine, ax * half_sine, ay * half_sine, az * half_sine};
        const LaneTurn orientation{in.orientation[0][i], in.orientation[1][i], in.orientation[2][i],
                                   in.orientation[3][i]};
        putLinear(turn * orientation, stretch, first + i, out);
        out[9][first + i] = static_cast<float>(in.position[0][i] + (vx + g.x * half) * elapsed);
        out[10][first + i] = static_cast<float>(in.position[1][i] + (vy + g.y * half) * elapsed);
        out[11][first + i] = static_cast<float>(in.position[2][i] + (vz + g.z * half) * elapsed);
    }
}

[[gnu::always_inline]] inline void poseHere(const FlightLanes& in, const Falling& falling, double t, Columns& out) {
    for (std::size_t k = 0; k < in.eights.size(); ++k) {
        poseEight(in.eights[k], falling, t, k * FlightLanes::kTogether, out);
    }
}

#if defined(__x86_64__)
// Wider registers where there are some; no fused operations, so that the bits are the same.
[[gnu::target("avx2")]] void poseWide(const FlightLanes& in, const Falling& falling, double t, Columns& out) {
    poseHere(in, falling, t, out);
}

} // namespace

void poseFlights(const FlightLanes& in, const Falling& falling, double t, Columns& out) {
    static const bool kWide = __builtin_cpu_supports("avx2");
    kWide ? poseWide(in, falling, t, out) : poseHere(in, falling, t, out);
}
#else
} // namespace

void poseFlights(const FlightLanes& in, const Falling& falling, double t, Columns& out) {
    poseHere(in, falling, t, out);
}
#endif

} // namespace elastoon
