// Based on: Chenney et al., NPAR 2002, sections 3.4 and 3.5. Where it deviates: docs/model.md.
#include "impact.h"

#include "contact.h"
#include "dmath.h"
#include "flight.h"
#include "rotation.h"
#include "slide.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace elastoon {

namespace {

/// Normal speeds below this share of the rest speed (and 1 nm/s) count as none.
constexpr double kNoSpeed = 1e-9;
/// A turn below this angle (rad) is rounding, and takes no time.
constexpr double kNoTurn = 1e-9;

/// What is known of the contact, at the moment of the touch, in the world.
struct Meeting {
    Vec3 normal{0.0};
    Vec3 relative_velocity{0.0};
    double normal_speed = 0.0; ///< of parting; negative when approaching
    double rest_speed = 0.0;
    bool can_hold = false;
    bool wedged = false; ///< it can, together with what else is touched
    bool can_skip = false; ///< there is a plane under it to skip along
};

/// How the body lies, in the surface's frame, that long after the touch.
Quat orientationAfter(const Impact& impact, double elapsed) {
    const double share =
        (turnShare(impact.curve, impact.easing, elapsed) - impact.turn_from) / (1.0 - impact.turn_from);
    return rotationAbout(impact.turn_axis, impact.turn_angle * share) * impact.orientation;
}

/// v_out - w: the normal part reflected and reduced, the tangential part kept. A surface that cannot hold the body
/// lets it go with the rest speed at least.
Vec3 relativeVelocityOut(const Meeting& meeting, double restitution, bool comes_to_rest) {
    if (comes_to_rest) {
        return Vec3(0.0);
    }
    const Vec3 tangential = meeting.relative_velocity - meeting.normal * meeting.normal_speed;
    const double reflected = restitution * std::max(0.0, -meeting.normal_speed);
    return tangential + meeting.normal * (meeting.can_hold ? reflected : std::max(reflected, meeting.rest_speed));
}

/// The end of the axis that points away from the surface. Turning it, and not the other, is the paper's forward swap.
Vec3 endAwayFrom(const Vec3& axis, const Vec3& normal) {
    return glm::dot(axis, normal) < 0.0 ? -axis : axis;
}

/// The turn about the contact that begins at time t, in the surface's frame, and the stretch that the coming flight
/// begins with. `away`: the side of the body that swaps to the front; zero for a skip, which turns the shorter way.
void planTurn(Impact& impact, double t, const Vec3& gravity, const Vec3& away, const Style& style) {
    const double end = impact.begun + impact.curve.duration();
    const Quat frame_at_end = impact.surface.frame.orientationAt(end);
    Vec3 target = impact.surface.normal;
    if (!impact.comes_to_rest) {
        const Vec3 velocity = velocityAfter(impact, end);
        const Pose unturned{Vec3(0.0), frame_at_end * impact.orientation, 1.0};
        const Flight next = beginFlight(unturned, velocity, gravity, style, Lead::Nearest);
        const Vec3 axis = next.rule == AxisRule::Fixed ? principalAxis(unturned.orientation) : leadingAxis(next, 0.0);
        target = endAwayFrom(glm::conjugate(frame_at_end) * axis, away);
        impact.curve.s_out = stretchAtSpeed(style, glm::length(velocity));
    }
    Vec3 from = endAwayFrom(principalAxis(impact.orientation), away);
    if (away == Vec3(0.0) && glm::dot(from, target) < 0.0) {
        from = -from;
    }
    const Turn turn = turnBetween(from, target, impact.surface.normal);
    impact.turn_axis = turn.axis;
    impact.turn_angle = turn.angle;
    impact.turn_from = t > impact.begun ? turnShare(impact.curve, impact.easing, t - impact.begun) : 0.0;
}

ImpactInput curveInput(const Impact& impact, const Touching& touching, const Meeting& meeting, const Style& style,
                       double length) {
    const double speed_out = glm::length(impact.velocity_out);
    const double s_out =
        impact.comes_to_rest ? 1.0 : stretchAtSpeed(style, glm::length(velocityAfter(impact, touching.time)));
    return {.length = length,
            .speed_in = glm::length(meeting.relative_velocity),
            .s_in = touching.pose.stretch,
            .speed_out = speed_out,
            .s_out = s_out,
            .rest_speed = meeting.rest_speed,
            .turns = impact.turn_angle > kNoTurn};
}

} // namespace

bool canHold(const Surface& surface, double t, const Vec3& gravity, const Style& style) {
    const double pull = glm::length(gravity);
    return pull > 0.0 && glm::dot(surface.normalAt(t), gravity) <= -pull * detSinCos(style.rest_slope).cos;
}

bool holdTogether(std::span<const Vec3> normals, const Vec3& gravity, const Style& style) {
    const double pull = glm::length(gravity);
    if (pull == 0.0 || normals.size() < 2) {
        return false;
    }
    // What is left of the pull when each pushes, and none pulls, as well as it can (projected Gauss-Seidel).
    constexpr int kRounds = 200;
    std::vector<double> pushes(normals.size(), 0.0);
    Vec3 left = gravity / pull;
    bool changes = true;
    for (int round = 0; round < kRounds && changes; ++round) {
        changes = false;
        for (std::size_t i = 0; i < normals.size(); ++i) {
            const double push = std::max(0.0, pushes[i] - glm::dot(left, normals[i]));
            changes = changes || push != pushes[i];
            left += normals[i] * (push - pushes[i]);
            pushes[i] = push;
        }
    }
    return glm::length(left) <= detSinCos(style.rest_slope).sin;
}

double holdsUntil(const Surface& surface, double t, const Vec3& gravity, const Style& style) {
    constexpr double kForGood = std::numeric_limits<double>::infinity();
    if (!canHold(surface, t, gravity, style)) {
        return -kForGood;
    }
    const double rate = glm::length(surface.frame.angular_velocity);
    if (rate == 0.0) {
        return kForGood;
    }
    // n . u = fixed + level cos(angle) + across sin(angle): it holds as far as that is the cosine of the steepest
    // slope.
    const Vec3 axis = surface.frame.angular_velocity / rate;
    const Vec3 up = -gravity / glm::length(gravity);
    const Vec3 normal = surface.normalAt(t);
    const double fixed = glm::dot(normal, axis) * glm::dot(axis, up);
    const double level = glm::dot(normal, up) - fixed;
    const double across = glm::dot(glm::cross(axis, normal), up);
    const double swing = std::sqrt(level * level + across * across);
    const double left = detSinCos(style.rest_slope).cos - fixed;
    if (left <= -swing) {
        return kForGood;
    }
    const double angle = detAtan2(across, level) + detAcos(left / swing);
    return t + std::max(0.0, angle) / rate;
}

namespace {

/// Share 0..1 by which a grazing touch sticks as any other does: 1 from the style's grazing angle up, 0 from half of it
/// down.
double sticking(const Meeting& meeting, const Style& style) {
    const double speed = glm::length(meeting.relative_velocity);
    const double sine = speed > 0.0 ? -meeting.normal_speed / speed : 1.0;
    const double upper = detSinCos(style.grazing_angle).sin;
    const double lower = detSinCos(0.5 * style.grazing_angle).sin;
    const double share = upper > lower ? std::clamp((sine - lower) / (upper - lower), 0.0, 1.0) : 1.0;
    return share * share * (3.0 - 2.0 * share);
}

/// How far the centroid comes along the surface, in the frame.
Vec3 wayAlong(const Impact& impact, const Shape& shape) {
    const double end = impact.begun + impact.curve.duration();
    const MovingFrame& frame = impact.surface.frame;
    const Vec3 way = frame.frameFromWorld(end, impactPose(impact, shape, end).position) -
                     frame.frameFromWorld(impact.begun, impactPose(impact, shape, impact.begun).position);
    return way - impact.surface.normal * glm::dot(way, impact.surface.normal);
}

/// A skip takes no more than a moment where nothing comes of it: the share, kLeastBrush..1, of its time.
constexpr double kLeastBrush = 0.01;
double brushing(const Impact& impact, const Meeting& meeting, const Style& style) {
    constexpr double kFullTurn = 0.2;
    constexpr double kFullChange = 0.05;
    const double speed = glm::length(meeting.relative_velocity);
    const double full = detSinCos(0.25 * style.grazing_angle).sin * speed;
    const double by_speed = full > 0.0 ? -meeting.normal_speed / full : 1.0;
    const double by_form =
        std::max(impact.turn_angle / kFullTurn, std::fabs(impact.curve.s_out - impact.curve.s_in) / kFullChange);
    return std::clamp(std::max(by_speed, by_form), kLeastBrush, 1.0);
}

/// Curve and turn. Below the grazing angle the body skips, so that it leaves where, when and as a touch above that
/// angle does in the limit: docs/contacts.md.
void planImpact(Impact& impact, const Touching& touching, const Meeting& meeting, const Shape& shape,
                const Style& style) {
    const bool turning = impact.surface.frame.angular_velocity != Vec3(0.0);
    const auto plan = [&](double sticks, const Vec3& away) {
        // Whether it turns decides whether it takes time, and on a turning surface the time decides how far it turns.
        for (int pass = 0; pass < 2; ++pass) {
            ImpactInput input = curveInput(impact, touching, meeting, style, shape.length());
            const ImpactCurve curve = impactCurve(style, input);
            if (pass > 0 && sticks >= 1.0 && !turning && curve == impact.curve) {
                break;
            }
            impact.curve = curve;
            if (sticks < 1.0) {
                input.speed_in = std::max(0.0, -meeting.normal_speed);
                input.speed_out = glm::dot(impact.velocity_out, impact.surface.normal);
                impact.curve = withTimesOf(skipCurve(style, input), impact.curve, sticks);
                impact.curve = inTimes(impact.curve, brushing(impact, meeting, style));
            }
            // What a groove holds stays as it lies: upright on one side it would leave the other.
            if (!(impact.comes_to_rest && meeting.wedged)) {
                planTurn(impact, touching.time, touching.gravity, away, style);
            }
        }
    };
    impact.skims = Vec3(0.0);
    plan(1.0, impact.surface.normal);
    const double sticks = impact.comes_to_rest || !meeting.can_skip ? 1.0 : sticking(meeting, style);
    if (sticks < 1.0) {
        const Vec3 way_of_swap = wayAlong(impact, shape);
        plan(sticks, Vec3(0.0));
        const double duration = impact.curve.duration();
        const Vec3 speed =
            impact.velocity_in - impact.surface.normal * glm::dot(impact.velocity_in, impact.surface.normal);
        const Vec3 limit = duration > 0.0 ? (way_of_swap - wayAlong(impact, shape)) / duration : speed;
        impact.skims = speed * (1.0 - sticks) + limit * sticks;
    }
}

/// The way (frame) from the solid's face to the centroid's foot once the body rests; zero where the face bears it.
Vec3 overhang(const Impact& impact, const Shape& shape) {
    const double end = impact.begun + impact.curve.duration();
    const Vec3 center = impact.surface.frame.frameFromWorld(end, impactPose(impact, shape, end).position);
    const Vec3 normal = impact.surface.normal;
    const Vec3 off = wayOffFace(impact.surface, center - normal * glm::dot(center - impact.surface.point, normal));
    constexpr double kBalanced = 1e-6;
    return glm::dot(off, off) > kBalanced * kBalanced * shape.length() * shape.length() ? off : Vec3(0.0);
}

} // namespace

std::optional<Impact> beginImpact(const Touching& touching, const Shape& shape, const Style& style) {
    const double t = touching.time;
    const MovingFrame& frame = touching.surface.frame;
    Meeting meeting;
    meeting.normal = touching.surface.normalAt(t);
    Vec3 contact = contactPoint(shape, touching.pose, touching.surface, t);
    contact -= meeting.normal * glm::dot(meeting.normal, contact - touching.surface.pointAt(t));
    meeting.relative_velocity = touching.velocity - frame.velocityAt(t, contact);
    meeting.normal_speed = glm::dot(meeting.relative_velocity, meeting.normal);
    meeting.rest_speed = restSpeed(style, shape.length(), glm::length(touching.gravity));
    meeting.can_hold = canHold(touching.surface, t, touching.gravity, style);
    if (!meeting.can_hold && !touching.besides.empty()) {
        std::vector<Vec3> touched = touching.besides;
        touched.push_back(meeting.normal);
        meeting.can_hold = meeting.wedged = holdTogether(touched, touching.gravity, style);
    }

    const Vec3 in_frame = frame.frameFromWorld(t, contact);
    const Vec3 way = glm::conjugate(frame.orientationAt(t)) * meeting.relative_velocity;
    meeting.can_skip =
        frame.angular_velocity == Vec3(0.0) && timeOnFace(touching.surface, in_frame, way, Vec3(0.0)) > 0.0;

    const double slow = (meeting.can_hold ? meeting.rest_speed : 0.0) + kNoSpeed * (1.0 + meeting.rest_speed);
    if (meeting.normal_speed > slow) {
        return std::nullopt;
    }
    Impact impact;
    impact.begun = t;
    impact.surface = touching.surface;
    impact.surface.point = in_frame;
    impact.easing = style.impact_easing;
    const Quat world_from_frame = frame.orientationAt(t);
    impact.orientation = unitOf(glm::conjugate(world_from_frame) * touching.pose.orientation);
    impact.contact_in_shape = (glm::conjugate(touching.pose.orientation) * (contact - touching.pose.position)) /
                              scaleOf(touching.pose.stretch);
    const double reflected = style.restitution * std::max(0.0, -meeting.normal_speed);
    // A groove stops also what would come up again by no more than this share of its size: every hop in it ends in a
    // turn that lifts the body once more.
    constexpr double kHopInGroove = 0.1;
    const double least_hop = std::sqrt(4.0 * glm::length(touching.gravity) * kHopInGroove * shape.boundingRadius());
    const bool stays = meeting.wedged ? style.restitution * glm::length(meeting.relative_velocity) < least_hop
                                      : reflected < meeting.rest_speed;
    impact.comes_to_rest = meeting.can_hold && stays;
    impact.velocity_in = glm::conjugate(world_from_frame) * meeting.relative_velocity;
    impact.velocity_out =
        glm::conjugate(world_from_frame) * relativeVelocityOut(meeting, style.restitution, impact.comes_to_rest);
    planImpact(impact, touching, meeting, shape, style);
    if (impact.skims != Vec3(0.0) && brushing(impact, meeting, style) <= kLeastBrush) {
        return std::nullopt;
    }
    if (impact.comes_to_rest && impact.surface.solid) {
        if (const Vec3 off = overhang(impact, shape); off != Vec3(0.0)) {
            // Beyond the edge nothing bears it: it tips off.
            impact.comes_to_rest = false;
            meeting.can_hold = false;
            impact.velocity_out =
                glm::conjugate(world_from_frame) * relativeVelocityOut(meeting, style.restitution, false);
            const Vec3 outward = glm::normalize(off);
            impact.velocity_out += outward * std::max(0.0, meeting.rest_speed - glm::dot(impact.velocity_out, outward));
            planImpact(impact, touching, meeting, shape, style);
        }
    }
    return impact;
}

Impact blendImpact(const Impact& impact, double t, std::span<const AlsoTouched> others, const Shape& shape,
                   const Style& style, const Vec3& gravity) {
    // Impulses that push and do not pull, each for its own surface (projected Gauss-Seidel); nothing depends on the
    // order of touching.
    std::vector<AlsoTouched> all{{impact.surface.normal, Vec3(0.0)}};
    all.insert(all.end(), others.begin(), others.end());
    std::vector<double> impulses(all.size(), 0.0);
    Vec3 velocity = impact.velocity_in;
    constexpr int kRounds = 200;
    for (int round = 0; round < kRounds; ++round) {
        for (std::size_t i = 0; i < all.size(); ++i) {
            const Vec3& normal = all[i].normal;
            const double approach = glm::dot(impact.velocity_in - all[i].velocity, normal);
            const double wanted = approach < 0.0 ? -style.restitution * approach : 0.0;
            const double lack = wanted - glm::dot(velocity - all[i].velocity, normal);
            const double impulse = std::max(0.0, impulses[i] + lack);
            velocity += normal * (impulse - impulses[i]);
            impulses[i] = impulse;
        }
    }
    Impact blended = impact;
    blended.velocity_out = velocity;
    const Vec3 thrown = velocity - impact.velocity_in;
    const double size = glm::length(thrown);
    const double elapsed = t - impact.begun;
    blended.orientation = orientationAfter(impact, elapsed);
    const double speed = glm::length(velocity);
    blended.curve = withEnd(impact.curve, style, shape.length(), speed,
                            stretchAtSpeed(style, glm::length(velocityAfter(blended, t))));
    planTurn(blended, t, gravity, size > 0.0 ? thrown / size : impact.surface.normal, style);
    return blended;
}

Impact steeredImpact(const Impact& impact, double t, const Vec3& velocity, const Shape& shape, const Style& style,
                     const Vec3& gravity) {
    Impact steered = impact;
    const double elapsed = t - impact.begun;
    const bool squashes = elapsed < impact.curve.t_in;
    steered.comes_to_rest = false;
    const auto aim = [&] {
        const double end = impact.begun + steered.curve.duration();
        steered.velocity_out = Vec3(0.0);
        const Vec3 carried = velocityAfter(steered, end);
        steered.velocity_out = glm::conjugate(impact.surface.frame.orientationAt(end)) * (velocity - carried);
    };
    aim();
    if (squashes) {
        steered.curve = withEnd(impact.curve, style, shape.length(), glm::length(steered.velocity_out),
                                stretchAtSpeed(style, glm::length(velocity)));
        aim();
        steered.orientation = orientationAfter(impact, elapsed);
        planTurn(steered, t, gravity, impact.skims == Vec3(0.0) ? impact.surface.normal : Vec3(0.0), style);
    }
    return steered;
}

Pose impactPose(const Impact& impact, const Shape& shape, double t, double factor) {
    const double elapsed = t - impact.begun;
    Pose in_frame;
    in_frame.stretch = factor * impact.curve.at(elapsed);
    in_frame.orientation = orientationAfter(impact, elapsed);

    // The contact's material point stays under the contact; then the body is moved along the normal until it touches.
    const Vec3 normal = impact.surface.normal;
    const Vec3 lever = in_frame.orientation * (scaleOf(in_frame.stretch) * impact.contact_in_shape);
    in_frame.position = impact.surface.point + impact.skims * elapsed - lever;
    in_frame.position += normal * liftToTouch(impact.surface, shape, in_frame);

    const MovingFrame& frame = impact.surface.frame;
    const Quat world_from_frame = frame.orientationAt(t);
    return {frame.originAt(t) + world_from_frame * in_frame.position, world_from_frame * in_frame.orientation,
            in_frame.stretch};
}

Vec3 impactVelocity(const Impact& impact, const Shape& shape, double t, double end) {
    constexpr double kHalfSpan = 1e-6;
    const double from = std::max(t - kHalfSpan, impact.begun);
    const double to = std::min(t + kHalfSpan, end);
    if (to - from < 0.5 * kHalfSpan) {
        return velocityAfter(impact, end);
    }
    return (impactPose(impact, shape, to).position - impactPose(impact, shape, from).position) / (to - from);
}

Vec3 velocityAfter(const Impact& impact, double end) {
    const MovingFrame& frame = impact.surface.frame;
    if (!frame.moves()) {
        // The sum is that of below, to the bit: it turns -0 into 0.
        return Vec3(0.0) + frame.orientation * impact.velocity_out;
    }
    const Vec3 contact = frame.worldFromFrame(end, impact.surface.point + impact.skims * (end - impact.begun));
    return frame.velocityAt(end, contact) + frame.orientationAt(end) * impact.velocity_out;
}

} // namespace elastoon
