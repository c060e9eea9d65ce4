// See witness.h.
#include "witness.h"

#include "play.h"

#include <algorithm>
#include <cmath>

namespace squashout {

using elastoon::Real;
using elastoon::RealVec;

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
    const std::vector<RealVec> vertices = elastoon::posedVertices(*shape, pose);
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
        const std::vector<RealVec> other = elastoon::posedVertices(*solid, {middle, frame.orientationAt(t), 1.0});
        if (elastoon::boxGap(vertices, other) > 0) {
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
