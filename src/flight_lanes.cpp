// See flight_lanes.h.
#include "flight_lanes.h"

#include "flight.h"

#include <cmath>

namespace elastoon {

void FlightLanes::set(std::size_t lane, const Phase& phase) {
    const auto& flight = phase.get<Flight>();
    const bool turns = flight.rule != AxisRule::Fixed && flight.speed_across > 0.0;
    start[lane] = phase.start;
    climb[lane] = flight.climb;
    stretch_rate[lane] = flight.stretch_rate;
    max_stretch[lane] = flight.max_stretch;
    // Negative: the axis is laid along the velocity. One that does not turn is a reversal straight up.
    across[lane] = turns ? flight.speed_across : 0.0;
    reversal_speed[lane] = !turns ? 1.0 : flight.rule == AxisRule::Reversal ? flight.reversal_speed : -1.0;
    const Heading first = turns ? headingAt(flight, 0.0) : Heading{1.0, 0.0};
    first_up[lane] = first.up;
    first_across[lane] = first.across;
    const Vec3 turn_axis = turns ? flight.turn_axis : Vec3(0.0);
    const auto put = [lane](std::array<Row, 3>& rows, const Vec3& from) {
        rows[0][lane] = from.x;
        rows[1][lane] = from.y;
        rows[2][lane] = from.z;
    };
    put(position, flight.position);
    put(velocity, flight.velocity);
    put(axis, turn_axis);
    orientation[0][lane] = flight.orientation.w;
    orientation[1][lane] = flight.orientation.x;
    orientation[2][lane] = flight.orientation.y;
    orientation[3][lane] = flight.orientation.z;
}

namespace {

[[gnu::always_inline]] inline void poseHere(const FlightLanes& in, const Vec3& gravity, double t, Columns& out) {
    const double gx = gravity.x, gy = gravity.y, gz = gravity.z;
    const double pull = glm::length(gravity);
    for (std::size_t i = 0; i < kLanes; ++i) {
        const double elapsed = t - in.start[i];
        const double half = 0.5 * elapsed;
        const double vx = in.velocity[0][i], vy = in.velocity[1][i], vz = in.velocity[2][i];
        const double wx = vx + gx * elapsed, wy = vy + gy * elapsed, wz = vz + gz * elapsed;
        const double scaled = in.stretch_rate[i] * std::sqrt(wx * wx + wy * wy + wz * wz);
        const double stretch = (scaled * in.max_stretch[i] + 1.0) / (scaled + 1.0);

        // The heading now, by its parts up and across.
        const double across = in.across[i];
        const double e = in.reversal_speed[i];
        const double climb_t = in.climb[i] - pull * elapsed;
        const bool along_velocity = e < 0.0;
        const double raw_up_t = along_velocity ? climb_t : climb_t * climb_t + e * e;
        const double raw_across_t = along_velocity ? across : climb_t * across;
        const double length_t = std::sqrt(raw_up_t * raw_up_t + raw_across_t * raw_across_t);
        const double up_0 = in.first_up[i], across_0 = in.first_across[i];
        const double up_t = raw_up_t / length_t, across_t = raw_across_t / length_t;

        // The turn from the one to the other.
        const double cosine = up_0 * up_t + across_0 * across_t;
        const double sine = up_0 * across_t - across_0 * up_t;
        const double larger = std::sqrt(0.5 * (1.0 + std::fabs(cosine)));
        const double smaller = 0.5 * sine / larger;
        const bool acute = cosine >= 0.0;
        const double half_sine = acute ? smaller : (sine < 0.0 ? -larger : larger);
        const double half_cosine = acute ? larger : std::fabs(smaller);
        const LaneTurn turn{half_cosine, in.axis[0][i] * half_sine, in.axis[1][i] * half_sine,
                            in.axis[2][i] * half_sine};
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
