// Based on: conservative advancement (Mirtich 1996) over the closed-form flight; the finish is the root finder of
// Chandrupatla (1997). The bounds on turning and lengthening are those of mostShapeRate(). docs/impact-time.md.
#include "touch.h"

#include "closest.h"
#include "contact.h"
#include "flight.h"
#include "push.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace elastoon {

namespace {

/// Below this gap (share of the length) the root is bracketed and finished, and is found to this gap.
constexpr double kFinishGap = 1e-5;
constexpr double kExact = 1e-13;
/// Penetrations up to this share of the length are rounding.
constexpr double kRounding = 1e-6;
constexpr int kMostAdvances = 10000;
/// A flight is pushed off what it leaves by no more than this times its reach and the push's gain.
constexpr double kPushReach = 4.0;

/// One flight against one plane.
struct Approach {
    const Phase& phase;
    const Flight& flight;
    const Shape& shape;
    const Surface& surface;
    bool turns = surface.frame.angular_velocity != Vec3(0.0);
    /// Of a plane that does not turn: its normal, and the way from its frame's origin to its point.
    Vec3 normal = surface.frame.orientation * surface.normal;
    Vec3 way_to_point = surface.frame.orientation * surface.point;

    [[nodiscard]] Vec3 normalAt(double t) const { return turns ? surface.normalAt(t) : normal; }
    [[nodiscard]] Vec3 pointAt(double t) const {
        return turns ? surface.pointAt(t) : surface.frame.originAt(t) + way_to_point;
    }
    /// As gapTo(), to the bit.
    [[nodiscard]] double gap(double t) const {
        const Pose pose = poseAt(phase, shape, t);
        const Vec3 way = normalAt(t);
        return glm::dot(way, pose.position - pointAt(t)) - reachTowards(shape, pose, -way);
    }
    /// Speed at which the unpushed centroid parts from the plane.
    [[nodiscard]] double partingSpeed(double t) const {
        const Vec3 velocity = flightVelocity(flight, t - phase.start);
        return glm::dot(velocity - surface.frame.velocity, normalAt(t));
    }
    /// Whether the body goes further from the plane all the time within [from, to].
    [[nodiscard]] bool partsAllAlong(double from, double to, const FlightBounds& bounds) const {
        const double slowest = turns ? 0.0 : std::min(partingSpeed(from), partingSpeed(to));
        return slowest > 0.0 && slowest > otherRate(from, to - from, bounds);
    }
    /// What may close the gap within [t, t + span] besides the centroid's own way along the normal, m/s; `bounds` hold
    /// for as long, or longer.
    [[nodiscard]] double otherRate(double t, double span, const FlightBounds& bounds) const {
        const double elapsed = t - phase.start;
        const double shape_rate = mostShapeRate(flight, shape, elapsed, elapsed + span, bounds);
        double rate = shape_rate + pushRate(t, span, bounds, shape_rate);
        const double spin = glm::length(surface.frame.angular_velocity);
        if (spin > 0.0) {
            const double arm = glm::length(flight.position - surface.frame.originAt(phase.start)) + bounds.reach +
                               (bounds.speed + glm::length(surface.frame.velocity)) * (elapsed + span);
            rate += spin * arm + (bounds.speed + glm::length(surface.frame.velocity)) * std::min(2.0, spin * span);
        }
        return rate;
    }
    [[nodiscard]] bool isPushed(double t) const { return !phase.clear_of.empty() && t < phase.free_from; }
    /// Greatest speed of the push off what the flight leaves; `shape_rate` is mostShapeRate() of that time.
    [[nodiscard]] double pushRate(double t, double span, const FlightBounds& bounds, double shape_rate) const {
        if (!isPushed(t)) {
            return 0.0;
        }
        const double gain = pushGain(phase, t);
        const double elapsed = t - phase.start;
        double rate = 0.0;
        for (const KeptClear& kept : phase.clear_of) {
            const MovingFrame& frame = kept.surface.frame;
            const double drift = (bounds.speed + glm::length(frame.velocity)) * (elapsed + span);
            const double arm = glm::length(flight.position - frame.originAt(t)) + bounds.reach + drift;
            const double turning = 2.0 * glm::length(frame.angular_velocity) * arm;
            rate = std::max(rate, bounds.speed + glm::length(frame.velocity) + shape_rate + turning);
        }
        return gain * rate;
    }
    /// Whether the widest bounding ball of the whole flight shows, quickly, that nothing touches within [from, to].
    [[nodiscard]] bool staysFar(double from, double to) const;
    /// Until when the bounding ball's way shows that nothing touches, within [from, to]; at least `from`.
    [[nodiscard]] double farUntil(double from, double to, const FlightBounds& bounds) const;
};

/// Time after which height + speed t + pull t^2 / 2 first reaches zero; height > 0. Infinite if never.
double timeToZero(double height, double speed, double pull) {
    const double discriminant = speed * speed - 2.0 * pull * height;
    if (discriminant < 0.0) {
        return std::numeric_limits<double>::infinity();
    }
    const double root = std::sqrt(discriminant);
    if (speed <= 0.0) {
        return root - speed > 0.0 ? 2.0 * height / (root - speed) : std::numeric_limits<double>::infinity();
    }
    return pull < 0.0 ? (speed + root) / -pull : std::numeric_limits<double>::infinity();
}

bool Approach::staysFar(double from, double to) const {
    if (turns) {
        return false;
    }
    const double longest = std::max(flight.max_stretch, flight.ease->stretch);
    const double flattest = std::min(1.0, flight.ease->stretch);
    const double widest = shape.boundingRadius() * std::max(longest, 1.0 / std::sqrt(flattest));
    const double reach = widest * (isPushed(from) ? 1.0 + kPushReach * pushGain(phase, from) : 1.0);
    const double elapsed = from - phase.start;
    const double span = to - from;
    const Vec3 position = flight.position + (flight.velocity + flight.gravity * (0.5 * elapsed)) * elapsed;
    const double height = glm::dot(position - pointAt(from), normal);
    const double speed = glm::dot(flightVelocity(flight, elapsed) - surface.frame.velocity, normal);
    const double pull = glm::dot(flight.gravity, normal);
    double least = std::min(height, height + (speed + 0.5 * pull * span) * span);
    if (pull > 0.0 && speed < 0.0 && -speed < pull * span) {
        least = height - 0.5 * speed * speed / pull;
    }
    constexpr double kMore = 1.0 + 1e-9;
    return least > kMore * reach;
}

double Approach::farUntil(double from, double to, const FlightBounds& bounds) const {
    if (turns) {
        return from;
    }
    const double span = to - from;
    if (isPushed(from)) {
        const double shape_rate = mostShapeRate(flight, shape, from - phase.start, to - phase.start, bounds);
        const double push = pushRate(from, span, bounds, shape_rate);
        const double way = (bounds.speed + push + glm::length(surface.frame.velocity)) * span;
        const Vec3 position = poseAt(phase, shape, from).position;
        return glm::dot(position - pointAt(from), normal) > bounds.reach + way ? to : from;
    }
    const double elapsed = from - phase.start;
    const Vec3 position = flight.position + (flight.velocity + flight.gravity * (0.5 * elapsed)) * elapsed;
    const double height = glm::dot(position - pointAt(from), normal) - bounds.reach;
    if (!(height > 0.0)) {
        return from;
    }
    constexpr double kShare = 1.0 - 1e-9;
    return std::min(to, from + kShare * timeToZero(height, partingSpeed(from), glm::dot(flight.gravity, normal)));
}

/// A time and how far the gap is there from what is looked for.
struct Sample {
    double t, off;
};

/// Where to look between the newest sample and the one on the other side, as a share of the way: inverse quadratic
/// interpolation with the one before where that is safe, else the middle (Chandrupatla 1997).
double shareToLookAt(const Sample& newest, const Sample& other, const Sample& before) {
    const double xi = (newest.t - other.t) / (before.t - other.t);
    const double phi = (newest.off - other.off) / (before.off - other.off);
    if (phi * phi >= xi || (1.0 - phi) * (1.0 - phi) >= 1.0 - xi) {
        return 0.5;
    }
    return newest.off / (other.off - newest.off) * before.off / (other.off - before.off) +
           (before.t - newest.t) / (other.t - newest.t) * newest.off / (before.off - newest.off) * other.off /
               (before.off - other.off);
}

/// gap(inside) > 0 > gap(beyond): the last time before the crossing, to rounding; never beyond it. What is looked for
/// is a gap of half of what is near enough, so that the last step need not be lucky to stay inside.
double finish(const Approach& approach, double inside, double gap_inside, double beyond, double gap_beyond) {
    const double enough = kExact * approach.shape.length();
    const double aim = 0.5 * enough;
    Sample newest{inside, gap_inside - aim};
    Sample other{beyond, gap_beyond - aim};
    double share = gap_inside / (gap_inside - gap_beyond);
    while (gap_inside > enough) {
        double t = newest.t + share * (other.t - newest.t);
        if (!(t > std::min(newest.t, other.t) && t < std::max(newest.t, other.t))) {
            t = newest.t + 0.5 * (other.t - newest.t);
            if (t == newest.t || t == other.t) {
                break;
            }
        }
        const double gap = approach.gap(t);
        if (gap >= 0.0) {
            inside = t;
            gap_inside = gap;
        }
        const bool same_side = (gap - aim > 0.0) == (newest.off > 0.0);
        const Sample before = same_side ? newest : other;
        other = same_side ? other : newest;
        newest = {t, gap - aim};
        share = shareToLookAt(newest, other, before);
    }
    return inside;
}

/// By looking often: for when the bounds on the rates are too wide to get on with.
std::optional<double> firstSeen(const Approach& approach, double from, double to) {
    constexpr int kLooks = 256;
    double apart = from;
    double gap_apart = approach.gap(from);
    for (int i = 1; i <= kLooks; ++i) {
        const double t = from + (to - from) * i / kLooks;
        const double gap = approach.gap(t);
        if (gap < 0.0) {
            return finish(approach, apart, gap_apart, t, gap);
        }
        apart = t;
        gap_apart = gap;
    }
    return std::nullopt;
}

} // namespace

namespace {

/// Conservative advancement from a time at which the body is apart from the plane or touches it.
std::optional<double> advance(const Approach& approach, double from, double to, double give_up) {
    const double length = approach.shape.length();
    const double start = approach.phase.start;
    const FlightBounds bounds = flightBounds(approach.flight, approach.shape, from - start, to - start);
    double t = approach.farUntil(from, to, bounds);
    if (t >= to && to > from) {
        return std::nullopt;
    }
    if (approach.partsAllAlong(t, to, bounds) && approach.gap(t) > kTouchGap * length) {
        return std::nullopt;
    }
    for (int i = 0; i < kMostAdvances; ++i) {
        if (t > give_up) {
            return std::nullopt;
        }
        const double gap = approach.gap(t);
        if (gap <= kTouchGap * length) {
            return t;
        }
        const double speed = approach.partingSpeed(t);
        const double pull =
            approach.turns ? -glm::length(approach.flight.gravity) : glm::dot(approach.flight.gravity, approach.normal);
        const double rate_now = approach.otherRate(t, 0.0, bounds);
        // Look ahead about twice as far as today's rates say that nothing can happen, and bound the rates over that.
        const double guess = timeToZero(gap, speed - rate_now, pull);
        const double span = std::min(2.0 * guess, to - t);
        const double rate = approach.otherRate(t, span, bounds);
        if (!approach.turns && speed + std::max(0.0, pull) * span + rate < 0.0) {
            // It comes nearer all the time: there is one root, or none.
            const double ahead = span < to - t ? t + span : to;
            const double gap_ahead = approach.gap(ahead);
            if (gap_ahead < 0.0) {
                return finish(approach, t, gap, ahead, gap_ahead);
            }
            if (ahead >= to) {
                return std::nullopt;
            }
            t = ahead;
            continue;
        }
        const double safe = std::min(timeToZero(gap, speed - rate, pull), span);
        if (gap < kFinishGap * length && speed < 0.0) {
            const double ahead = std::min(to, t + 2.0 * gap / -speed + 1e-12);
            const double gap_ahead = approach.gap(ahead);
            if (gap_ahead < 0.0) {
                return finish(approach, t, gap, ahead, gap_ahead);
            }
        }
        const double next = t + safe;
        if (next >= to) {
            return approach.gap(to) < 0.0 ? std::optional(to) : std::nullopt;
        }
        t = next > t ? next : std::nextafter(t, to);
    }
    return firstSeen(approach, t, to);
}

} // namespace

std::optional<double> firstTouch(const Phase& flight, const Shape& shape, const Surface& surface, double from,
                                 double to, double give_up) {
    const Approach approach{flight, flight.get<Flight>(), shape, surface};
    double begin = from;
    // While it is pushed it has no simple way; that lasts a short time only.
    if (!flight.clear_of.empty() && flight.free_from > from && flight.free_from < to) {
        if (!approach.staysFar(from, flight.free_from)) {
            if (const auto touch = advance(approach, from, flight.free_from, give_up)) {
                return touch;
            }
        }
        begin = flight.free_from;
    }
    return approach.staysFar(begin, to) ? std::nullopt : advance(approach, begin, to, give_up);
}

void findFreeFrom(Phase& flight, const Shape& shape) {
    // Without what it is kept clear of the phase is on its own way.
    std::vector<KeptClear> clear_of = std::exchange(flight.clear_of, {});
    double free_from = flight.start;
    for (const KeptClear& kept : clear_of) {
        const double span = kept.until - flight.start;
        // Past the last time, which still counts.
        double free = std::nextafter(kept.until, std::numeric_limits<double>::infinity());
        for (const double share : {0.02, 0.1, 0.3}) {
            const double t = flight.start + share * span;
            if (span < std::numeric_limits<double>::infinity() &&
                !firstTouch(flight, shape, kept.surface, t, kept.until)) {
                free = t;
                break;
            }
        }
        free_from = std::max(free_from, free);
    }
    flight.clear_of = std::move(clear_of);
    flight.free_from = free_from;
}

bool hasLeftAll(const Phase& phase, double t) {
    return phase.is<Flight>() && t >= phase.free_from &&
           std::all_of(phase.clear_of.begin(), phase.clear_of.end(),
                       [t](const KeptClear& kept) { return kept.until < t; });
}

namespace {

/// The supporting plane of the solid in direction `normal` (world, unit) at time t, carried by the solid's frame.
Surface supportingPlane(const ShapePtr& solid, const MovingFrame& frame, const Vec3& normal, double t) {
    Surface surface;
    surface.frame = frame;
    surface.normal = glm::normalize(glm::conjugate(frame.orientationAt(t)) * normal);
    surface.point = solid->vertices()[solid->supportVertex(surface.normal)];
    surface.solid = solid;
    return surface;
}

PosedShape posed(const Shape& shape, const Pose& pose) {
    return {&shape, linearOf(pose), pose.position};
}

PosedShape posed(const ShapePtr& solid, const MovingFrame& frame, double t) {
    return {solid.get(), glm::mat3_cast(frame.orientationAt(t)), frame.originAt(t)};
}

/// A supporting plane of the solid that parts it best from a body that touches it, or nearly so. A vanishing distance
/// has no direction, so the body is also looked at from a hair outside, along each of the hints.
Surface partingPlane(const Shape& shape, const Pose& pose, const ShapePtr& solid, const MovingFrame& frame, double t,
                     std::span<const Vec3> hints) {
    const double hair = kRounding * shape.length();
    Surface best;
    double widest = -std::numeric_limits<double>::infinity();
    const auto consider = [&](const Vec3& normal) {
        const Surface plane = supportingPlane(solid, frame, normal, t);
        const double gap = gapTo(plane, shape, pose, t);
        if (gap > widest) {
            widest = gap;
            best = plane;
        }
    };
    for (const Vec3& hint : hints) {
        Pose outside = pose;
        outside.position += hint * hair;
        ClosestSeed seed;
        const Closest closest = closestPoints(posed(shape, outside), posed(solid, frame, t), seed);
        consider(!closest.overlap && closest.distance > 1e-3 * hair
                     ? (closest.point_a - closest.point_b) / closest.distance
                     : hint);
    }
    return best;
}

/// From the solid's centre to the body's.
Vec3 centerLine(const Pose& pose, const Vec3& solid_center) {
    const Vec3 between = pose.position - solid_center;
    const double length = glm::length(between);
    return length > 0.0 ? between / length : Vec3(0.0, 1.0, 0.0);
}

/// Until when the bounding balls' ways show that the two do not meet, within [from, to]; at least `from`.
double ballsApartUntil(const Phase& phase, const Shape& shape, const Shape& solid, const MovingFrame& frame,
                       double from, double to) {
    const auto& flight = phase.get<Flight>();
    const FlightBounds bounds = flightBounds(flight, shape, from - phase.start, to - phase.start);
    const double speed = bounds.speed + glm::length(frame.velocity);
    const bool pushed = !phase.clear_of.empty() && from < phase.free_from;
    const double reach =
        bounds.reach + solid.boundingRadius() + (pushed ? kPushReach * pushGain(phase, from) * bounds.reach : 0.0);
    constexpr int kMostLooks = 16;
    double t = from;
    for (int i = 0; i < kMostLooks && t < to; ++i) {
        const double elapsed = t - phase.start;
        const Vec3 position = flight.position + (flight.velocity + flight.gravity * (0.5 * elapsed)) * elapsed;
        const double apart = glm::length(position - frame.originAt(t)) - reach;
        if (!(apart > 0.01 * reach)) {
            break;
        }
        t += apart / speed;
    }
    return std::min(t, to);
}

/// The face that has the bounding ball's whole way before it for longest, from `from` on.
struct FaceAhead {
    std::size_t face;
    double until; ///< at most the end of the time asked for
};

/// None where the ball is before no face, or where the faces cannot tell.
std::optional<FaceAhead> faceAhead(const Phase& phase, const Shape& shape, const Shape& solid, const MovingFrame& frame,
                                   double from, double to) {
    constexpr std::size_t kMostFaces = 32;
    const auto& normals = solid.topology().face_normals;
    const bool pushed = !phase.clear_of.empty() && from < phase.free_from;
    if (pushed || frame.angular_velocity != Vec3(0.0) || normals.size() > kMostFaces) {
        return std::nullopt;
    }
    const auto& flight = phase.get<Flight>();
    const double elapsed = from - phase.start;
    const double reach = flightBounds(flight, shape, elapsed, to - phase.start).reach;
    const Quat frame_from_world = glm::conjugate(frame.orientationAt(from));
    const Vec3 position = flight.position + (flight.velocity + flight.gravity * (0.5 * elapsed)) * elapsed;
    const Vec3 in_frame = frame_from_world * (position - frame.originAt(from));
    const Vec3 velocity = frame_from_world * (flightVelocity(flight, elapsed) - frame.velocity);
    const Vec3 gravity = frame_from_world * flight.gravity;
    constexpr double kShare = 1.0 - 1e-9;
    std::optional<FaceAhead> latest;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const double height = glm::dot(normals[i], in_frame - solid.vertices()[solid.face(i)[0]]) - reach;
        if (height > 0.0) {
            const double span = timeToZero(height, glm::dot(normals[i], velocity), glm::dot(normals[i], gravity));
            const double until = std::min(to, from + kShare * span);
            if (!latest || until > latest->until) {
                latest = {i, until};
            }
        }
    }
    return latest;
}

/// The plane of the solid's face.
Surface facePlane(const ShapePtr& solid, const MovingFrame& frame, std::size_t face) {
    return {frame, solid->vertices()[solid->face(face)[0]], solid->topology().face_normals[face], solid};
}

/// That the body, which touches the face's plane, does so within the face.
bool touchesFace(const Surface& plane, std::size_t face, const Shape& shape, const Pose& pose, double t) {
    const Vec3 lowest = furthestPoint(shape, pose, -plane.normalAt(t));
    return isOverFace(*plane.solid, face, plane.frame.frameFromWorld(t, lowest));
}

/// Directions in which a body that touches a solid may lie from it.
std::vector<Vec3> hintsOf(const Phase& phase, const Pose& pose, const MovingFrame& frame, double t) {
    std::vector<Vec3> hints{centerLine(pose, frame.originAt(t))};
    for (const KeptClear& kept : phase.clear_of) {
        hints.push_back(kept.surface.normalAt(t));
    }
    return hints;
}

} // namespace

std::optional<Touch> firstSolidTouch(const Phase& flight, const Shape& shape, const ShapePtr& solid,
                                     const MovingFrame& frame, double from, double to, ClosestSeed& seed,
                                     double give_up) {
    double t = ballsApartUntil(flight, shape, *solid, frame, from, to);
    if ((t >= to && to > from) || t > give_up) {
        return std::nullopt;
    }
    // A plane between the two keeps them apart until the body touches it; then a better plane is sought.
    std::optional<Surface> plane;
    if (const auto ahead = faceAhead(flight, shape, *solid, frame, t, to)) {
        plane = facePlane(solid, frame, ahead->face);
        const std::optional<double> next = firstTouch(flight, shape, *plane, ahead->until, to, give_up);
        if (!next || touchesFace(*plane, ahead->face, shape, poseAt(flight, shape, *next), *next)) {
            return next ? std::optional(Touch{*next, *plane}) : std::nullopt;
        }
        t = *next;
    }
    for (int i = 0; i < kMostAdvances; ++i) {
        const Pose pose = poseAt(flight, shape, t);
        const Closest closest = closestPoints(posed(shape, pose), posed(solid, frame, t), seed);
        const bool touches = closest.overlap || closest.distance <= kSolidTouchGap * shape.length();
        // At the touch itself the plane that led there parts the two; a vanishing distance has no direction.
        if (!touches) {
            plane = supportingPlane(solid, frame, (closest.point_a - closest.point_b) / closest.distance, t);
        } else if (!plane) {
            plane = partingPlane(shape, pose, solid, frame, t, hintsOf(flight, pose, frame, t));
        }
        if (touches) {
            return Touch{t, *plane};
        }
        const std::optional<double> next = firstTouch(flight, shape, *plane, t, to, give_up);
        if (!next) {
            return std::nullopt;
        }
        if (*next <= t) {
            return Touch{t, *plane};
        }
        t = *next;
    }
    return std::nullopt;
}

namespace {

/// That the surface's plane holds a face of its solid, and the body touches it there.
bool isOnItsFace(const Surface& surface, const Shape& shape, const Pose& pose, double t) {
    const Quat frame_from_world = glm::conjugate(surface.frame.orientationAt(t));
    const Pose in_frame{surface.frame.frameFromWorld(t, pose.position), frame_from_world * pose.orientation,
                        pose.stretch};
    const auto lift = liftOntoFace(surface, shape, in_frame);
    return lift && std::fabs(*lift) <= kRounding * shape.length();
}

} // namespace

Surface separatingPlane(const Surface& surface, const Shape& shape, const Pose& pose, double t) {
    Surface plane = surface;
    plane.solid = nullptr;
    if (surface.solid && !isOnItsFace(surface, shape, pose, t)) {
        const std::array hints{surface.normalAt(t), centerLine(pose, surface.frame.originAt(t))};
        plane = partingPlane(shape, pose, surface.solid, surface.frame, t, hints);
        plane.solid = nullptr;
    }
    // On a turning surface the velocity under the contact counts.
    const Vec3 normal = plane.normalAt(t);
    double gap = gapTo(plane, shape, pose, t);
    const Vec3 contact = contactPoint(shape, pose, plane, t);
    if (surface.solid && gap < 0.0 && gap > -kRounding * shape.length()) {
        gap = 0.0;
    }
    plane.point = plane.frame.frameFromWorld(t, contact - normal * gap);
    return plane;
}

} // namespace elastoon
