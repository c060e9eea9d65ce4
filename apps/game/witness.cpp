// See witness.h.
#include "witness.h"

#include "play.h"

#include <algorithm>
#include <cmath>

namespace squashout {

using elastoon::Real;
using elastoon::RealVec;

namespace {

/// The shape's vertices under rotation, scale and shift, all in extended precision.
std::vector<RealVec> posed(const elastoon::Shape& shape, const elastoon::Quat& q, double stretch, const Vec3& shift) {
    const Real w = q.w;
    const Real x = q.x;
    const Real y = q.y;
    const Real z = q.z;
    const Real across = 1 / std::sqrt(static_cast<Real>(stretch));
    std::vector<RealVec> vertices;
    vertices.reserve(shape.vertices().size());
    for (const Vec3& vertex : shape.vertices()) {
        const Real a = vertex.x * static_cast<Real>(stretch);
        const Real b = vertex.y * across;
        const Real c = vertex.z * across;
        vertices.push_back(
            {(1 - 2 * (y * y + z * z)) * a + 2 * (x * y - w * z) * b + 2 * (x * z + w * y) * c + shift.x,
             2 * (x * y + w * z) * a + (1 - 2 * (x * x + z * z)) * b + 2 * (y * z - w * x) * c + shift.y,
             2 * (x * z - w * y) * a + 2 * (y * z + w * x) * b + (1 - 2 * (x * x + y * y)) * c + shift.z});
    }
    return vertices;
}

/// Least distance that two sets of points can have, by their boxes.
Real boxGap(const std::vector<RealVec>& a, const std::vector<RealVec>& b) {
    Real gap = -1e9L;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto less = [axis](const RealVec& p, const RealVec& q) { return p[axis] < q[axis]; };
        const auto [low_a, high_a] = std::minmax_element(a.begin(), a.end(), less);
        const auto [low_b, high_b] = std::minmax_element(b.begin(), b.end(), less);
        gap = std::max({gap, (*low_b)[axis] - (*high_a)[axis], (*low_a)[axis] - (*high_b)[axis]});
    }
    return gap;
}

} // namespace

void Seen::add(const Seen& other) {
    if (other.solid_depth > solid_depth) {
        deepest_where = other.deepest_where;
    }
    depth = std::max(depth, other.depth);
    solid_depth = std::max(solid_depth, other.solid_depth);
    slowest = std::min(slowest, other.slowest);
    fastest = std::max(fastest, other.fastest);
    longest_contact = std::max(longest_contact, other.longest_contact);
    looks += other.looks;
    not_finite += other.not_finite;
    escapes += other.escapes;
    squeezes += other.squeezes;
}

const elastoon::SolidWitness& Witness::solidOf(const elastoon::ShapePtr& shape) {
    return solids_.try_emplace(shape->contentHash(), *shape).first->second;
}

void Witness::lookAt(const Game& game, const Ball& ball, const elastoon::Phase& phase, double t) {
    const elastoon::World& world = game.world();
    const elastoon::ShapePtr& shape = world.shape(ball.body);
    const elastoon::Pose pose = elastoon::poseAt(phase, *shape, t);
    const std::vector<RealVec> vertices = posed(*shape, pose.orientation, pose.stretch, pose.position);
    ++seen_.looks;
    const double length = shape->length();
    for (const RealVec& vertex : vertices) {
        if (!std::isfinite(vertex[0] + vertex[1] + vertex[2])) {
            ++seen_.not_finite;
            return;
        }
        const Real over =
            std::max({std::fabs(vertex[0]) - static_cast<Real>(kHalfWidth), vertex[1] - static_cast<Real>(kCeiling)});
        seen_.depth = std::max(seen_.depth, static_cast<double>(over) / length);
    }
    for (const elastoon::ObstacleId id : world.obstacles()) {
        const elastoon::ShapePtr& solid = world.shape(id);
        const elastoon::MovingFrame& frame = world.frame(id);
        if (solid == nullptr || t < frame.start) {
            continue;
        }
        const Vec3 middle = frame.originAt(t);
        constexpr double kMostStretch = 3.0;
        if (glm::length(middle - pose.position) > solid->boundingRadius() + kMostStretch * shape->boundingRadius()) {
            continue;
        }
        // Boxes first: all candidate axes take long.
        const std::vector<RealVec> other = posed(*solid, frame.orientationAt(t), 1.0, middle);
        if (boxGap(vertices, other) > 0) {
            continue;
        }
        const Real gap = elastoon::separationBySat({&solidOf(shape), vertices}, {&solidOf(solid), other});
        const double depth = static_cast<double>(-gap) / length;
        if (depth > seen_.solid_depth) {
            seen_.solid_depth = depth;
            seen_.deepest_where = "seed " + hexOf(game.def().seed) + ", step " + std::to_string(game.steps()) +
                                  (id == game.paddle().obstacle ? ", paddle, " : ", block, ") +
                                  std::string(elastoon::nameOf(phase));
        }
    }
}

void Witness::look(const Game& game) {
    const elastoon::World& world = game.world();
    seen_.escapes = static_cast<std::size_t>(game.escapes());
    for (const elastoon::Event& event : world.events()) {
        seen_.squeezes += event.type == elastoon::EventType::Squeeze ? 1 : 0;
    }
    std::map<std::uint32_t, double> contacts;
    for (const Ball& ball : game.balls()) {
        const elastoon::Phase& phase = world.phase(ball.body);
        lookAt(game, ball, phase, world.time());
        for (const elastoon::PhaseBegun& begun : world.phasesBegun()) {
            if (begun.body == ball.body && begun.phase.start > world.time() - kStep) {
                lookAt(game, ball, begun.phase, begun.phase.start);
            }
        }
        if (!phase.is<elastoon::Flight>()) {
            const auto before = contact_since_.find(ball.id);
            contacts[ball.id] = before == contact_since_.end() ? world.time() : before->second;
            seen_.longest_contact = std::max(seen_.longest_contact, world.time() - contacts[ball.id]);
            continue;
        }
        const double pull = game.def().gravity ? game.level().gravity : 0.0;
        const double speed = glm::length(world.velocity(ball.body));
        const double height = world.pose(ball.body).position.y;
        const double at_half = std::sqrt(std::max(0.0, speed * speed + 2.0 * pull * (height - 0.5 * kCeiling)));
        const double share = at_half / game.level().speed;
        seen_.slowest = std::min(seen_.slowest, share);
        seen_.fastest = std::max(seen_.fastest, share);
    }
    contact_since_ = std::move(contacts);
}

} // namespace squashout
