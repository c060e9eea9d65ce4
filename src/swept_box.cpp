// See swept_box.h.
#include "swept_box.h"

#include "flight.h"
#include "held_bounds.h"
#include "push.h"

#include <algorithm>
#include <cmath>

namespace elastoon {

namespace {

Box grown(const Box& box, double by) {
    return {box.low - by, box.high + by};
}

double largestIn(const Box& box) {
    const Vec3 most = glm::max(glm::abs(box.low), glm::abs(box.high));
    return std::max(std::max(most.x, most.y), most.z);
}

/// Rounding of positions between the ends of a span of time, as a share of what they are made from.
constexpr double kRounding = 1e-14;

/// Box of the flight's centroid before any push; times since its start.
Box parabolaBox(const Flight& flight, double from, double to) {
    const auto at = [&](double elapsed) {
        return flight.position + (flight.velocity + flight.gravity * (0.5 * elapsed)) * elapsed;
    };
    Box box = unionOf({at(from), at(from)}, {at(to), at(to)});
    for (int axis = 0; axis < 3; ++axis) {
        if (flight.gravity[axis] == 0.0) {
            continue;
        }
        const double turn = -flight.velocity[axis] / flight.gravity[axis];
        if (turn > from && turn < to) {
            const double extreme = at(turn)[axis];
            box.low[axis] = std::min(box.low[axis], extreme);
            box.high[axis] = std::max(box.high[axis], extreme);
        }
    }
    return box;
}

/// The most that the body is pushed off a surface it leaves, within [from, to] since the flight's start at `start`:
/// its reach, and the way that its centroid may be behind the plane.
double mostPush(const Flight& flight, const Surface& surface, double start, double from, double to,
                const FlightBounds& bounds) {
    const Vec3 position = flight.position + (flight.velocity + flight.gravity * (0.5 * from)) * from;
    const Vec3 normal = surface.normalAt(start + from);
    const double height = glm::dot(position - surface.pointAt(start + from), normal);
    const double span = to - from;
    const double spin = glm::length(surface.frame.angular_velocity);
    double least = height;
    if (spin == 0.0) {
        const double speed = glm::dot(flight.velocity + flight.gravity * from - surface.frame.velocity, normal);
        const double pull = glm::dot(flight.gravity, normal);
        least = std::min(height, height + (speed + 0.5 * pull * span) * span);
        if (pull > 0.0 && speed < 0.0 && -speed < pull * span) {
            least = height - 0.5 * speed * speed / pull;
        }
    } else {
        // The plane turns about its frame's origin: its height there changes by the turning of (position - origin).
        const double drift = (bounds.speed + glm::length(surface.frame.velocity)) * span;
        const double arm = glm::length(position - surface.frame.originAt(start + from));
        least = height - drift - std::min(2.0, spin * span) * (arm + drift);
    }
    return std::max(0.0, bounds.reach - least);
}

} // namespace

Box boxOf(const Shape& shape, const MovingFrame& frame, double t) {
    const Vec3 origin = frame.originAt(t);
    const Quat orientation = frame.orientationAt(t);
    const Vec3 first = origin + orientation * shape.vertices().front();
    Box box{first, first};
    for (const Vec3& vertex : shape.vertices()) {
        const Vec3 corner = origin + orientation * vertex;
        box = unionOf(box, {corner, corner});
    }
    return box;
}

Box sweptBox(const Shape& shape, const MovingFrame& frame, double from, double to) {
    const double rate = glm::length(frame.angular_velocity);
    const double radius = shape.boundingRadius();
    const double angle = rate * (to - from);
    const double slack =
        kRounding * (radius + rate * radius * std::max(std::fabs(from - frame.start), std::fabs(to - frame.start)));
    Box box;
    constexpr double kWholeTurn = 6.3;
    if (angle >= kWholeTurn) {
        const Vec3 a = frame.originAt(from);
        const Vec3 b = frame.originAt(to);
        box = grown({glm::min(a, b), glm::max(a, b)}, radius);
    } else {
        // Between two times a corner strays from its chord by no more than its acceleration allows.
        constexpr double kPieceAngle = 0.3;
        const int pieces = 1 + static_cast<int>(angle / kPieceAngle);
        const double piece_angle = angle / pieces;
        box = boxOf(shape, frame, from);
        for (int i = 1; i <= pieces; ++i) {
            box = unionOf(box, boxOf(shape, frame, i == pieces ? to : from + (to - from) * i / pieces));
        }
        box = grown(box, radius * piece_angle * piece_angle / 8.0);
    }
    return frame.moves() ? grown(box, slack + kRounding * largestIn(box)) : box;
}

namespace {

/// Box of a body that is held by a surface.
Box heldBox(const Phase& phase, const Shape& shape, double from, double to) {
    const HeldBounds bounds = heldBounds(phase, shape, from, to);
    const auto drum = drumAboutContact(phase, bounds.reach, to);
    if (drum && drum->radius < bounds.reach + bounds.speed * (to - from)) {
        Box box;
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 along(0.0);
            along[axis] = 1.0;
            box.low[axis] = drum->foot[axis] + drum->lowest(along);
            box.high[axis] = drum->foot[axis] - drum->lowest(-along);
        }
        return box;
    }
    const Vec3 center = poseAt(phase, shape, from).position;
    return grown({center, center}, bounds.reach + bounds.speed * (to - from));
}

/// Box of the ways that a body in flight may be pushed off what it leaves.
Box pushedBox(const Phase& phase, const Box& box, double first, double last, const FlightBounds& bounds) {
    const auto& flight = phase.get<Flight>();
    Box pushed = box;
    double sum = 0.0;
    for (const KeptClear& kept : phase.clear_of) {
        if (kept.until < phase.start + first) {
            continue;
        }
        const double until = std::max(first, std::min(last, kept.until - phase.start));
        const double push = mostPush(flight, kept.surface, phase.start, first, until, bounds);
        sum += push;
        const Vec3 way = kept.surface.normalAt(phase.start) * push;
        pushed = unionOf(pushed, {box.low + way, box.high + way});
    }
    const bool along_one =
        phase.clear_of.size() == 1 && phase.clear_of.front().surface.frame.angular_velocity == Vec3(0.0);
    return along_one || sum == 0.0 ? pushed : grown(box, 3.0 * pushGain(phase, phase.start + first) * sum);
}

} // namespace

Box sweptBox(const Phase& phase, const Shape& shape, double from, double to) {
    if (!phase.is<Flight>()) {
        return heldBox(phase, shape, std::max(from, phase.start), std::max(to, phase.start));
    }
    const auto& flight = phase.get<Flight>();
    const double first = std::max(0.0, from - phase.start);
    const double last = std::max(first, to - phase.start);
    const FlightBounds bounds = flightBounds(flight, shape, first, last);
    Box box = grown(parabolaBox(flight, first, last), bounds.reach);
    box = pushedBox(phase, box, first, last, bounds);
    return grown(box, kRounding * (largestIn(box) + bounds.speed * last));
}

} // namespace elastoon
