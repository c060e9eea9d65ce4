// See impact_lanes.h. Between what all lanes do at once each looks up the vertex that touches.
#include "impact_lanes.h"

#include "contact.h"
#include "dmath.h"
#include "dmath_series.h"
#include "support.h"

#include <cmath>

namespace elastoon {

bool ImpactLanes::fits(const Phase& phase) {
    const auto* impact = phase.as<Impact>();
    return impact != nullptr && phase.clear_of.empty() && !impact->surface.frame.moves();
}

void ImpactLanes::set(std::size_t lane, const Impact& impact, const Shape& shape) {
    const auto put = [lane](std::array<Row, 3>& rows, const Vec3& from) {
        for (int axis = 0; axis < 3; ++axis) {
            rows[static_cast<std::size_t>(axis)][lane] = from[axis];
        }
    };
    const auto turn = [lane](std::array<Row, 4>& rows, const Quat& from) {
        rows[0][lane] = from.w;
        rows[1][lane] = from.x;
        rows[2][lane] = from.y;
        rows[3][lane] = from.z;
    };
    shapes[lane] = &shape;
    surfaces[lane] = &impact.surface;
    begun[lane] = impact.begun;
    s_in[lane] = impact.curve.s_in;
    s_mid[lane] = impact.curve.s_mid;
    s_out[lane] = impact.curve.s_out;
    omega_in[lane] = impact.curve.omega_in;
    omega_out[lane] = impact.curve.omega_out;
    t_in[lane] = impact.curve.t_in;
    t_out[lane] = impact.curve.t_out;
    turn_angle[lane] = impact.turn_angle;
    turn_from[lane] = impact.turn_from;
    smooth[lane] = impact.easing == ImpactEasing::Smooth ? 1.0 : 0.0;
    put(point, impact.surface.point);
    put(normal, impact.surface.normal);
    put(contact, impact.contact_in_shape);
    put(turn_axis, impact.turn_axis);
    put(skims, impact.skims);
    turn(orientation, impact.orientation);
    put(origin, impact.surface.frame.origin);
    turn(frame, impact.surface.frame.orientation);
}

namespace {

/// Of the poses, in the surface's frame: all but the way that lifts the body until it touches.
struct Lying {
    Row stretch, thin; ///< thin: 1 / root of the stretch
    std::array<Row, 4> turn; ///< w, x, y, z
    std::array<Row, 3> position;
    std::array<Row, 3> down; ///< into the plane, in the shape, times the stretch's root: as reachTowards() has it
    Row reach{}; ///< of the shape that way
    Row lift{}; ///< where it is lifted onto a solid
    Row on_solid{}; ///< 1, else 0
};

struct SineCosine {
    double sine, cosine;
};

/// detSinCos() for angles from 0 to a right angle and a little more.
[[gnu::always_inline]] inline SineCosine sineCosine(double angle) {
    const bool beyond = angle * (2.0 / kPi) + 0.5 >= 1.0;
    const double k = beyond ? 1.0 : 0.0;
    const double reduced = ((angle - k * kHalfPiHigh) - k * kHalfPiMiddle) - k * kHalfPiLow;
    const double s = sinSeries(reduced);
    const double c = cosSeries(reduced);
    return {beyond ? c : s, beyond ? -s : c};
}

/// A vector that is turned.
[[gnu::always_inline]] inline void turned(const LaneTurn& q, double vx, double vy, double vz, double& ox, double& oy,
                                          double& oz) {
    const double ux = q.y * vz - vy * q.z, uy = q.z * vx - vz * q.x, uz = q.x * vy - vx * q.y;
    const double tx = q.y * uz - uy * q.z, ty = q.z * ux - uz * q.x, tz = q.x * uy - ux * q.y;
    ox = vx + (ux * q.w + tx) * 2.0;
    oy = vy + (uy * q.w + ty) * 2.0;
    oz = vz + (uz * q.w + tz) * 2.0;
}

[[gnu::always_inline]] inline void lieHere(const ImpactLanes& in, double t, Lying& __restrict out) {
    for (std::size_t i = 0; i < kLanes; ++i) {
        const double t_in = in.t_in[i], t_out = in.t_out[i];
        const double elapsed = t - in.begun[i];
        const double duration = t_in + t_out;
        const bool before = elapsed <= 0.0, over = elapsed >= duration, squashes = elapsed < t_in;

        // ImpactCurve::at().
        const double s_in = in.s_in[i], s_mid = in.s_mid[i], s_out = in.s_out[i];
        const SineCosine wave = sineCosine(squashes ? in.omega_in[i] * elapsed : in.omega_out[i] * (elapsed - t_in));
        const double on_way = squashes ? s_in - (s_in - s_mid) * wave.sine : s_out - (s_out - s_mid) * wave.cosine;
        const double last = over ? s_out : on_way;
        const double stretch = before ? (duration > 0.0 ? s_in : last) : last;

        // turnShare().
        const bool smooth = in.smooth[i] > 0.0;
        const double x = elapsed / duration;
        const double whole = smooth ? x * x * (3.0 - 2.0 * x) : x;
        const double half_length = squashes ? t_in : t_out;
        const double u = (squashes ? elapsed : duration - elapsed) / half_length;
        const double m = 2.0 * half_length / (t_in < t_out ? t_out : t_in);
        const double half = smooth ? u * u * ((3.0 - m) + (m - 2.0) * u) : u;
        const double of_halves = squashes ? 0.5 * half : 1.0 - 0.5 * half;
        const double in_halves = t_in <= 0.0 ? whole : t_out <= 0.0 ? whole : of_halves;
        const double share = over ? 1.0 : before ? 0.0 : in_halves;

        // orientationAfter().
        const double done = (share - in.turn_from[i]) / (1.0 - in.turn_from[i]);
        const SineCosine about = sineCosine(0.5 * (in.turn_angle[i] * done));
        const LaneTurn turn{about.cosine, in.turn_axis[0][i] * about.sine, in.turn_axis[1][i] * about.sine,
                            in.turn_axis[2][i] * about.sine};
        const LaneTurn first{in.orientation[0][i], in.orientation[1][i], in.orientation[2][i], in.orientation[3][i]};
        const LaneTurn q = turn * first;

        // The contact stays where it is.
        const double root = std::sqrt(stretch);
        const double thin = 1.0 / root;
        double lever_x, lever_y, lever_z;
        turned(q, stretch * in.contact[0][i], thin * in.contact[1][i], thin * in.contact[2][i], lever_x, lever_y,
               lever_z);
        out.stretch[i] = stretch;
        out.thin[i] = thin;
        out.turn[0][i] = q.w;
        out.turn[1][i] = q.x;
        out.turn[2][i] = q.y;
        out.turn[3][i] = q.z;
        out.position[0][i] = in.point[0][i] + in.skims[0][i] * elapsed - lever_x;
        out.position[1][i] = in.point[1][i] + in.skims[1][i] * elapsed - lever_y;
        out.position[2][i] = in.point[2][i] + in.skims[2][i] * elapsed - lever_z;
        double down_x;
        turned({q.w, -q.x, -q.y, -q.z}, -in.normal[0][i], -in.normal[1][i], -in.normal[2][i], down_x, out.down[1][i],
               out.down[2][i]);
        out.down[0][i] = stretch * root * down_x;
    }
}

[[gnu::always_inline]] inline void liftHere(const ImpactLanes& in, const Lying& lying, Columns& out) {
    for (std::size_t i = 0; i < kLanes; ++i) {
        // liftToTouch() of a plane; that of a solid is known.
        const double stretch = lying.stretch[i];
        const double reach = lying.thin[i] * lying.reach[i];
        const double nx = in.normal[0][i], ny = in.normal[1][i], nz = in.normal[2][i];
        const double bx = lying.position[0][i], by = lying.position[1][i], bz = lying.position[2][i];
        const double onto_plane =
            reach - (nx * (bx - in.point[0][i]) + ny * (by - in.point[1][i]) + nz * (bz - in.point[2][i]));
        const double lift = lying.on_solid[i] > 0.0 ? lying.lift[i] : onto_plane;
        // From the surface's frame to the world.
        const LaneTurn frame{in.frame[0][i], in.frame[1][i], in.frame[2][i], in.frame[3][i]};
        double x, y, z;
        turned(frame, bx + nx * lift, by + ny * lift, bz + nz * lift, x, y, z);
        const LaneTurn in_frame{lying.turn[0][i], lying.turn[1][i], lying.turn[2][i], lying.turn[3][i]};
        putLinear(frame * in_frame, stretch, i, out);
        out[9][i] = static_cast<float>(in.origin[0][i] + x);
        out[10][i] = static_cast<float>(in.origin[1][i] + y);
        out[11][i] = static_cast<float>(in.origin[2][i] + z);
    }
}

/// What each lane's lift comes from: above a plane how far its shape reaches down.
void findLifts(const ImpactLanes& in, std::size_t count, Lying& lying) {
    for (std::size_t i = 0; i < count; ++i) {
        const Shape& shape = *in.shapes[i];
        if (in.surfaces[i]->solid) {
            const Pose pose{{lying.position[0][i], lying.position[1][i], lying.position[2][i]},
                            {lying.turn[0][i], lying.turn[1][i], lying.turn[2][i], lying.turn[3][i]},
                            lying.stretch[i]};
            lying.lift[i] = liftToTouch(*in.surfaces[i], shape, pose);
            lying.on_solid[i] = 1.0;
            continue;
        }
        lying.reach[i] = reachOf(shape, {lying.down[0][i], lying.down[1][i], lying.down[2][i]});
    }
}

#if defined(__x86_64__)
// As in flight_lanes.cpp.
[[gnu::target("avx2")]] void lieWide(const ImpactLanes& in, double t, Lying& __restrict out) {
    lieHere(in, t, out);
}
[[gnu::target("avx2")]] void liftWide(const ImpactLanes& in, const Lying& lying, Columns& out) {
    liftHere(in, lying, out);
}
#endif

} // namespace

void poseImpacts(const ImpactLanes& in, std::size_t count, double t, Columns& out) {
    Lying lying;
#if defined(__x86_64__)
    static const bool kWide = __builtin_cpu_supports("avx2");
    kWide ? lieWide(in, t, lying) : lieHere(in, t, lying);
    findLifts(in, count, lying);
    kWide ? liftWide(in, lying, out) : liftHere(in, lying, out);
#else
    lieHere(in, t, lying);
    findLifts(in, count, lying);
    liftHere(in, lying, out);
#endif
}

} // namespace elastoon
