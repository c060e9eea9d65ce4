// A constant acceleration along the surface: gravity's part, and friction against the way that the slide began with.
// Where the way turns, a new slide begins. See slide.h.
#include "slide.h"

#include "contact.h"
#include "contact_region.h"
#include "dmath.h"
#include "elastoon/model.h"
#include "flight.h"
#include "rotation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace elastoon {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
/// Steeper than this (cosine of 75 degrees) nothing slides; it is left.
constexpr double kSteepest = 0.25881904510252074;
/// Tangent of the turn (10 degrees) after which friction takes a new direction.
constexpr double kTurned = 0.17632698070846498;
/// Friction on a slope that cannot hold the body is at most this share of what pulls it down; where it can, the other
/// way round.
constexpr double kMostOfPull = 0.8;
/// Sines up to this are rounding.
constexpr double kStraight = 1e-9;
/// A face's vertices lie this near to its plane, as a share of the solid.
constexpr double kFlatness = 1e-9;

/// The corners of the solid's face under the surface's plane, in plane coordinates about the plane's point.
struct Face {
    Vec3 u, v;
    std::vector<FlatPoint> corners;

    [[nodiscard]] FlatPoint flat(const Vec3& way) const { return {glm::dot(way, u), glm::dot(way, v)}; }
};

Face faceUnder(const Surface& surface) {
    Face face;
    face.u = anyAcross(surface.normal);
    face.v = glm::cross(surface.normal, face.u);
    const Shape& solid = *surface.solid;
    const double top = glm::dot(surface.normal, solid.vertices()[solid.supportVertex(surface.normal)]);
    std::vector<FlatPoint> points;
    for (const Vec3& vertex : solid.vertices()) {
        if (glm::dot(surface.normal, vertex) >= top - kFlatness * solid.boundingRadius()) {
            points.push_back(face.flat(vertex - surface.point));
        }
    }
    face.corners = flatHull(std::move(points));
    return face;
}

/// First t > 0 at which height + speed t + pull t^2 / 2, not positive at 0, is positive.
double timeToPass(double height, double speed, double pull) {
    if (height > 0.0) {
        return 0.0;
    }
    const double discriminant = speed * speed - 2.0 * pull * height;
    if (pull == 0.0 || discriminant < 0.0) {
        return pull == 0.0 && speed > 0.0 ? -height / speed : kNever;
    }
    const double root = std::sqrt(discriminant);
    if (pull > 0.0) {
        return speed >= 0.0 ? (speed + root > 0.0 ? -2.0 * height / (speed + root) : kNever) : (root - speed) / pull;
    }
    return speed > 0.0 ? -2.0 * height / (speed + root) : kNever;
}

/// Friction and gravity along the surface, in the frame.
Vec3 accelerationOf(const Touching& touching, const Style& style, const Vec3& normal, const Vec3& direction,
                    bool can_hold) {
    const Vec3 gravity = touching.gravity;
    const double press = std::max(0.0, -glm::dot(gravity, normal));
    const Vec3 pull = gravity - normal * glm::dot(gravity, normal);
    // A surface that can hold the body stops it, one that cannot does not, whatever the friction.
    const double drag = style.friction * press;
    const double needed = glm::length(pull);
    const Vec3 total =
        pull - direction * (can_hold ? std::max(drag, needed / kMostOfPull) : std::min(drag, kMostOfPull * needed));
    // What is across by rounding alone would turn the way where it ends.
    const double along = glm::dot(total, direction);
    return glm::length(total - direction * along) > kStraight * glm::length(total) ? total : direction * along;
}

/// How long the slide keeps its way: until it stops along it, or turns from it.
double timeOnWay(const Slide& slide) {
    const double speed = glm::length(slide.velocity);
    const double along = glm::dot(slide.acceleration, slide.direction);
    const double across = glm::length(slide.acceleration - slide.direction * along);
    double time = along < 0.0 ? speed / -along : kNever;
    const double turning = across - kTurned * along;
    if (across > kStraight * glm::length(slide.acceleration) && turning > 0.0) {
        time = std::min(time, kTurned * speed / turning);
    }
    return time;
}

} // namespace

double timeOnFace(const Surface& surface, const Vec3& foot, const Vec3& velocity, const Vec3& acceleration) {
    if (!surface.solid) {
        return kNever;
    }
    const Face face = faceUnder(surface);
    if (face.corners.size() < 3) {
        return 0.0;
    }
    const FlatPoint at = face.flat(foot - surface.point);
    const FlatPoint speed = face.flat(velocity);
    const FlatPoint pull = face.flat(acceleration);
    double first = kNever;
    for (std::size_t i = 0; i < face.corners.size(); ++i) {
        const FlatPoint& a = face.corners[i];
        const FlatPoint& b = face.corners[(i + 1) % face.corners.size()];
        const FlatPoint out{b.second - a.second, a.first - b.first};
        const auto beyond = [&](const FlatPoint& p) { return out.first * p.first + out.second * p.second; };
        first = std::min(first, timeToPass(beyond(at) - beyond(a), beyond(speed), beyond(pull)));
    }
    return first;
}

Vec3 wayOffFace(const Surface& surface, const Vec3& foot) {
    if (!surface.solid) {
        return Vec3(0.0);
    }
    const Face face = faceUnder(surface);
    const FlatPoint at = face.flat(foot - surface.point);
    FlatPoint nearest = face.corners.front();
    double least = kNever;
    bool inside = face.corners.size() >= 3;
    for (std::size_t i = 0; i < face.corners.size(); ++i) {
        const FlatPoint& a = face.corners[i];
        const FlatPoint& b = face.corners[(i + 1) % face.corners.size()];
        const FlatPoint edge{b.first - a.first, b.second - a.second};
        const FlatPoint way{at.first - a.first, at.second - a.second};
        inside = inside && edge.first * way.second - edge.second * way.first >= 0.0;
        const double squared = edge.first * edge.first + edge.second * edge.second;
        const double share =
            squared > 0.0 ? std::clamp((edge.first * way.first + edge.second * way.second) / squared, 0.0, 1.0) : 0.0;
        const FlatPoint foot_on_edge{a.first + share * edge.first, a.second + share * edge.second};
        const double dx = at.first - foot_on_edge.first;
        const double dy = at.second - foot_on_edge.second;
        if (dx * dx + dy * dy < least) {
            least = dx * dx + dy * dy;
            nearest = foot_on_edge;
        }
    }
    return inside ? Vec3(0.0) : face.u * (at.first - nearest.first) + face.v * (at.second - nearest.second);
}

namespace {

/// The contact under the body in its own form at the start, in the frame.
Vec3 contactAlongWay(const Slide& slide, const Shape& shape) {
    Slide plain = slide;
    plain.ease = {};
    plain.surface.solid = nullptr;
    const double t = slide.begun;
    Surface plane = slide.surface;
    plane.solid = nullptr;
    return plane.frame.frameFromWorld(t, contactPoint(shape, slidePose(plain, shape, t), plane, t));
}

} // namespace

std::optional<SlideBegun> beginSlide(const Touching& touching, const Shape& shape, const Style& style) {
    const double t = touching.time;
    const Surface& surface = touching.surface;
    const double gravity = glm::length(touching.gravity);
    if (surface.frame.angular_velocity != Vec3(0.0) || gravity == 0.0) {
        return std::nullopt;
    }
    const Vec3 normal = surface.normalAt(t);
    const Vec3 relative = touching.velocity - surface.frame.velocity;
    const double parting = glm::dot(relative, normal);
    const Vec3 tangential = relative - normal * parting;
    const double speed = glm::length(tangential);
    const double rest_speed = restSpeed(style, shape.length(), gravity);
    const bool can_hold = canHold(surface, t, touching.gravity, style);
    const bool slow = style.restitution * std::max(0.0, -parting) < rest_speed &&
                      parting <= (can_hold ? rest_speed : 1e-9 * (1.0 + rest_speed));
    if (!slow || (can_hold ? speed <= rest_speed : -glm::dot(normal, touching.gravity) < kSteepest * gravity)) {
        return std::nullopt;
    }
    std::vector<Vec3> touched = touching.besides;
    touched.push_back(normal);
    if (!can_hold && holdTogether(touched, touching.gravity, style)) {
        return std::nullopt;
    }
    const Vec3 pull = touching.gravity - normal * glm::dot(touching.gravity, normal);
    const Quat frame_from_world = glm::conjugate(surface.frame.orientation);
    const Vec3 way = speed > 1e-6 * rest_speed ? tangential / speed : glm::normalize(pull);
    SlideBegun begun;
    Slide& slide = begun.slide;
    slide.begun = t;
    slide.surface = surface;
    slide.direction = frame_from_world * way;
    slide.velocity = frame_from_world * tangential;
    slide.acceleration = frame_from_world * accelerationOf(touching, style, normal, way, can_hold);
    const Vec3 center = surface.frame.frameFromWorld(t, touching.pose.position);
    slide.foot = center - surface.normal * glm::dot(center - surface.point, surface.normal);
    slide.max_stretch = style.max_stretch;
    slide.stretch_rate = style.stretch_rate;
    const Quat orientation = unitOf(frame_from_world * touching.pose.orientation);
    const Vec3 axis = principalAxis(orientation);
    const Vec3 target = glm::dot(axis, slide.direction) < 0.0 ? -slide.direction : slide.direction;
    slide.orientation = unitOf(rotationBetween(axis, target) * orientation);
    const Pose own = slidePose(slide, shape, t);
    slide.ease =
        easeBetween({Vec3(0.0), orientation, touching.pose.stretch},
                    {Vec3(0.0), frame_from_world * own.orientation, own.stretch}, settlingTime(style, shape.length()));
    const Vec3 contact = contactAlongWay(slide, shape);
    begun.duration = std::min({timeOnWay(slide), timeOnFace(surface, slide.foot, slide.velocity, slide.acceleration),
                               timeOnFace(surface, contact, slide.velocity, slide.acceleration)});
    if (!(begun.duration > 0.0)) {
        return std::nullopt;
    }
    return begun;
}

Vec3 slideVelocity(const Slide& slide, double t) {
    return slide.velocity + slide.acceleration * (t - slide.begun);
}

double slideStretch(const Slide& slide, double speed) {
    const double scaled = slide.stretch_rate * speed;
    return (scaled * slide.max_stretch + 1.0) / (scaled + 1.0);
}

Pose slidePose(const Slide& slide, const Shape& shape, double t, double factor) {
    const double elapsed = t - slide.begun;
    const Vec3 velocity = slideVelocity(slide, t);
    const double speed = glm::length(velocity);
    Pose pose;
    pose.stretch = slideStretch(slide, speed);
    pose.orientation = slide.orientation;
    // Of a straight slide only rounding is across, which is all that is left where it stops.
    constexpr double kRounding = 1e-13;
    const bool turns = glm::length(glm::cross(slide.direction, velocity)) > kRounding * glm::length(slide.velocity);
    if (turns && glm::dot(velocity, slide.direction) > 0.5 * speed) {
        pose.orientation = rotationBetween(slide.direction, velocity / speed) * pose.orientation;
    }
    applyEase(slide.ease, elapsed, pose);
    pose.stretch *= factor;
    const Vec3 foot = slide.foot + (slide.velocity + slide.acceleration * (0.5 * elapsed)) * elapsed;
    pose.position = foot;
    pose.position += slide.surface.normal * liftToTouch(slide.surface, shape, pose);
    const MovingFrame& frame = slide.surface.frame;
    return {frame.worldFromFrame(t, pose.position), frame.orientation * pose.orientation, pose.stretch};
}

} // namespace elastoon
