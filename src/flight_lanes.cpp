// See flight_lanes.h.
#include "flight_lanes.h"

#include "flight.h"

#include <cmath>

namespace elastoon {

void FlightLanes::set(std::size_t lane, double began, const Flight& flight) {
    start[lane] = began;
    reversal_speed[lane] = flight.reversal_speed;
    max_stretch[lane] = flight.max_stretch;
    stretch_rate[lane] = flight.stretch_rate;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        position[axis][lane] = flight.position[static_cast<int>(axis)];
        velocity[axis][lane] = flight.velocity[static_cast<int>(axis)];
    }
    orientation[0][lane] = flight.orientation.w;
    orientation[1][lane] = flight.orientation.x;
    orientation[2][lane] = flight.orientation.y;
    orientation[3][lane] = flight.orientation.z;
}

Flight FlightLanes::get(std::size_t lane, const Vec3& gravity) const {
    Flight flight;
    flight.position = {position[0][lane], position[1][lane], position[2][lane]};
    flight.velocity = {velocity[0][lane], velocity[1][lane], velocity[2][lane]};
    flight.gravity = gravity;
    flight.orientation = {orientation[0][lane], orientation[1][lane], orientation[2][lane], orientation[3][lane]};
    flight.reversal_speed = reversal_speed[lane];
    flight.max_stretch = max_stretch[lane];
    flight.stretch_rate = stretch_rate[lane];
    completeFlight(flight);
    return flight;
}

namespace {

[[gnu::always_inline]] inline void poseHere(const FlightLanes& in, const Vec3& gravity, double t, Columns& out) {
    const double gx = gravity.x, gy = gravity.y, gz = gravity.z;
    const double pull = glm::length(gravity);
    const bool pulls = pull > kLeastPull;
    const Vec3 up = pulls ? -gravity / pull : Vec3(0.0);
    for (std::size_t i = 0; i < kLanes; ++i) {
        const double elapsed = t - in.start[i];
        const double half = 0.5 * elapsed;
        const double vx = in.velocity[0][i], vy = in.velocity[1][i], vz = in.velocity[2][i];
        const double wx = vx + gx * elapsed, wy = vy + gy * elapsed, wz = vz + gz * elapsed;
        const double scaled = in.stretch_rate[i] * std::sqrt(wx * wx + wy * wy + wz * wz);
        const double stretch = (scaled * in.max_stretch[i] + 1.0) / (scaled + 1.0);

        // The plane of the parabola. What does not turn is a reversal straight up.
        const double climb_0 = vx * up.x + vy * up.y + vz * up.z;
        const double climb_t = climb_0 - pull * elapsed;
        const double sx = vx - up.x * climb_0, sy = vy - up.y * climb_0, sz = vz - up.z * climb_0;
        const double square = sx * sx + sy * sy + sz * sz;
        const bool turns = pulls & (square > kNothingAcross * (vx * vx + vy * vy + vz * vz));
        const double across = turns ? std::sqrt(square) : 0.0;
        const double inverse = 1.0 / (turns ? across : 1.0);
        const double hx = sx * inverse, hy = sy * inverse, hz = sz * inverse;
        const double ax = up.y * hz - hy * up.z, ay = up.z * hx - hz * up.x, az = up.x * hy - hx * up.y;

        // The heading at the start and now, by its parts up and across, of any length.
        const bool along_velocity = turns & (across >= in.reversal_speed[i]);
        const double e = turns ? in.reversal_speed[i] : 1.0;
        const double up_0 = along_velocity ? climb_0 : climb_0 * climb_0 + e * e;
        const double up_t = along_velocity ? climb_t : climb_t * climb_t + e * e;
        const double across_0 = along_velocity ? across : climb_0 * across;
        const double across_t = along_velocity ? across : climb_t * across;

        // The turn from the one to the other.
        const double dot = up_0 * up_t + across_0 * across_t;
        const double cross = up_0 * across_t - across_0 * up_t;
        const double inverse_length = 1.0 / std::sqrt(dot * dot + cross * cross);
        const double cosine = dot * inverse_length;
        const double sine = cross * inverse_length;
        const double larger = std::sqrt(0.5 * (1.0 + std::fabs(cosine)));
        const double smaller = 0.5 * sine / larger;
        const bool acute = cosine >= 0.0;
        const double half_sine = acute ? smaller : (sine < 0.0 ? -larger : larger);
        const double half_cosine = acute ? larger : std::fabs(smaller);
        const LaneTurn turn{half_cosine, ax * half_sine, ay * half_sine, az * half_sine};
        const LaneTurn first{in.orientation[0][i], in.orientation[1][i], in.orientation[2][i], in.orientation[3][i]};
        putLinear(turn * first, stretch, i, out);
        out[9][i] = static_cast<float>(in.position[0][i] + (vx + gx * half) * elapsed);
        out[10][i] = static_cast<float>(in.position[1][i] + (vy + gy * half) * elapsed);
        out[11][i] = static_cast<float>(in.position[2][i] + (vz + gz * half) * elapsed);
    }
}

#if defined(__x86_64__)
// Wider registers where there are some; no fused operations, so that the bits are the same.
[[gnu::target("avx2")]] void poseWide(const FlightLanes& in, const Vec3& gravity, double t, Columns& out) {
    poseHere(in, gravity, t, out);
}

} // namespace

void poseFlights(const FlightLanes& in, const Vec3& gravity, double t, Columns& out) {
    static const bool kWide = __builtin_cpu_supports("avx2");
    kWide ? poseWide(in, gravity, t, out) : poseHere(in, gravity, t, out);
}
#else
} // namespace

void poseFlights(const FlightLanes& in, const Vec3& gravity, double t, Columns& out) {
    poseHere(in, gravity, t, out);
}
#endif

} // namespace elastoon
