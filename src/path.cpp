// See path.h.
#include "path.h"

#include "rotation.h"

#include <cmath>
#include <limits>

namespace elastoon {

namespace {

/// Where a time lies on the path: which lap, and the key that it comes to next (keys.size(): past the last).
struct OnPath {
    double lap_start = 0.0;
    std::size_t next = 0;
};

OnPath find(const Path& path, double t) {
    OnPath on{path.added, 0};
    const double lap = path.keys.back().time;
    if (path.repeats) {
        double laps = std::floor((t - path.added) / lap);
        // A time that is the end of a lap to rounding belongs to the next one.
        if (path.added + (laps + 1.0) * lap <= t) {
            laps += 1.0;
        }
        on.lap_start = path.added + laps * lap;
    }
    while (on.next < path.keys.size() && on.lap_start + path.keys[on.next].time <= t) {
        ++on.next;
    }
    if (path.repeats && on.next == path.keys.size()) {
        on = {on.lap_start + lap, 0};
        // A key right after the start may be at the same time to rounding: what changes must change later.
        while (on.next + 1 < path.keys.size() && on.lap_start + path.keys[on.next].time <= t) {
            ++on.next;
        }
    }
    return on;
}

} // namespace

MovingFrame frameBetween(double from, const Vec3& position, const Quat& rotation, double to, const Vec3& next_position,
                         const Quat& next_rotation) {
    MovingFrame frame;
    frame.start = from;
    frame.origin = position;
    frame.orientation = unitOf(rotation);
    const double span = to - from;
    frame.velocity = (next_position - position) / span;
    const Quat turn = unitOf(next_rotation) * glm::conjugate(frame.orientation);
    const double sine = std::sqrt(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);
    if (sine > 0.0) {
        const double angle = 2.0 * detAtan2(sine, std::fabs(turn.w));
        frame.angular_velocity = Vec3(turn.x, turn.y, turn.z) * ((turn.w < 0.0 ? -angle : angle) / (sine * span));
    }
    return frame;
}

MovingFrame frameAt(const Path& path, double t) {
    const OnPath on = find(path, t);
    const Vec3 from = on.next == 0 ? path.position : path.keys[on.next - 1].position;
    const Quat rotation = on.next == 0 ? path.rotation : path.keys[on.next - 1].rotation;
    const double start = on.next == 0 ? on.lap_start : on.lap_start + path.keys[on.next - 1].time;
    if (on.next == path.keys.size()) {
        MovingFrame frame;
        frame.start = start;
        frame.origin = from;
        frame.orientation = unitOf(rotation);
        return frame;
    }
    const PathKey& to = path.keys[on.next];
    return frameBetween(start, from, rotation, on.lap_start + to.time, to.position, to.rotation);
}

double nextChange(const Path& path, double t) {
    const OnPath on = find(path, t);
    return on.next == path.keys.size() ? std::numeric_limits<double>::infinity()
                                       : on.lap_start + path.keys[on.next].time;
}

bool ObstacleDef::moves() const {
    return !path.empty() || velocity != Vec3(0.0) || angular_velocity != Vec3(0.0);
}

MovingFrame frameAt(const ObstacleDef& def, double added, double t) {
    if (def.path.empty()) {
        return {added, def.position, unitOf(def.rotation), def.velocity, def.angular_velocity};
    }
    return frameAt(Path{added, def.position, def.rotation, def.path, def.path_repeats}, t);
}

} // namespace elastoon
