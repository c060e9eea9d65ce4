// See phase.h: moving frames, and the dispatch from a phase to its pose.
#include "elastoon/phase.h"

#include "contact.h"
#include "flight.h"
#include "impact.h"
#include "push.h"
#include "rotation.h"
#include "slide.h"

#include <algorithm>

namespace elastoon {

Quat MovingFrame::turnedAt(double t) const {
    const double rate = glm::length(angular_velocity);
    if (rate == 0.0) {
        return orientation;
    }
    return unitOf(rotationAbout(angular_velocity / rate, rate * (t - start)) * orientation);
}

Vec3 MovingFrame::velocityAt(double t, const Vec3& point) const {
    return velocity + glm::cross(angular_velocity, point - originAt(t));
}

std::string_view nameOf(const Phase& phase) {
    constexpr std::string_view kNames[] = {"flight", "impact", "rest", "slide"};
    return kNames[phase.motion.index()];
}

namespace {

Pose restPose(const Rest& rest, const Shape& shape, double t, double factor, const Quat& turn) {
    const MovingFrame& frame = rest.surface.frame;
    Pose pose = rest.pose;
    if (factor != 1.0 || turn != kNoRotation) {
        // Squashed, and turned, where it stands.
        const double reach = reachTowards(shape, pose, -rest.surface.normal);
        pose.stretch *= factor;
        if (turn != kNoRotation) {
            pose.orientation = unitOf(turn * pose.orientation);
        }
        pose.position += rest.surface.normal * (reachTowards(shape, pose, -rest.surface.normal) - reach);
        if (rest.surface.solid) {
            // It may hang over the solid's edge.
            pose.position += rest.surface.normal * liftToTouch(rest.surface, shape, pose);
        }
    }
    if (!frame.moves()) {
        return {frame.origin + frame.orientation * pose.position, frame.orientation * pose.orientation, pose.stretch};
    }
    return {frame.worldFromFrame(t, pose.position), frame.orientationAt(t) * pose.orientation, pose.stretch};
}

} // namespace

Pose ownPose(const Phase& phase, const Shape& shape, double t, double factor, const Quat& turn) {
    const double time = std::max(t, phase.start);
    if (const auto* flight = phase.as<Flight>()) {
        Pose pose = unpushedPose(*flight, time - phase.start);
        pose.stretch *= factor;
        return pose;
    }
    if (const auto* impact = phase.as<Impact>()) {
        return impactPose(*impact, shape, time, factor);
    }
    if (const auto* slide = phase.as<Slide>()) {
        return slidePose(*slide, shape, time, factor);
    }
    return restPose(phase.get<Rest>(), shape, time, factor, turn);
}

Pose poseAt(const Phase& phase, const Shape& shape, double t) {
    return phase.clear_of.empty() || t >= phase.free_from ? ownPose(phase, shape, t)
                                                          : keptClear(phase, shape, std::max(t, phase.start));
}

Vec3 velocityAt(const Phase& phase, const Shape& shape, double t) {
    const double time = std::max(t, phase.start);
    if (const auto* flight = phase.as<Flight>()) {
        return flightVelocity(*flight, time - phase.start);
    }
    if (const auto* impact = phase.as<Impact>()) {
        return impactVelocity(*impact, shape, time, phase.end);
    }
    if (const auto* slide = phase.as<Slide>()) {
        const MovingFrame& frame = slide->surface.frame;
        return frame.velocity + frame.orientation * slideVelocity(*slide, time);
    }
    const auto& rest = phase.get<Rest>();
    return rest.surface.frame.velocityAt(time, restPose(rest, shape, time, 1.0, kNoRotation).position);
}

} // namespace elastoon
