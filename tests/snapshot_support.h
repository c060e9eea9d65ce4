// What the tests of snapshots and recordings share: busy worlds that users change all the time, from a seed.
#pragma once

#include "elastoon/recorder.h"
#include "test_support.h"

#include <cstring>

namespace elastoon {

inline std::vector<ShapePtr> busyShapes() {
    return {valueOf(Shape::box({0.3, 1.0, 0.5})), valueOf(Shape::cylinder(0.4, 0.8, 16)),
            valueOf(Shape::sphere(0.4, 2)),       valueOf(Shape::capsule(0.2, 1.1, 8)),
            valueOf(Shape::cone(0.5, 1.0, 12)),   valueOf(Shape::box({3, 1, 3}))};
}

/// A room with obstacles that stand, go round on paths and turn. `Target` is a World or a Recorder.
class BusyRoom {
public:
    explicit BusyRoom(std::uint64_t seed, int bodies = 16) : random_(seed), body_count_(bodies) {}

    template <class Target>
    void furnish(Target& target, const World& world) {
        for (int axis = 0; axis < 3; ++axis) {
            for (const double side : {-1.0, 1.0}) {
                ObstacleDef plane;
                plane.normal = Vec3(0.0);
                plane.normal[axis] = -side;
                plane.position[axis] = 6.0 * side;
                plane.user_data = 7;
                (void)target.addObstacle(plane);
            }
        }
        for (int i = 0; i < 12; ++i) {
            (void)target.addObstacle(anyObstacle());
        }
        for (int i = 0; i < body_count_; ++i) {
            addBody(target, world);
        }
    }

    /// What the user does before one step: nothing, most of the time.
    template <class Target>
    void change(Target& target, const World& world) {
        const auto bodies = world.bodies();
        const auto obstacles = world.obstacles();
        if (bodies.empty() || obstacles.size() < 8 || random_.below(6) != 0) {
            return;
        }
        const BodyId body = bodies[static_cast<std::size_t>(random_.below(static_cast<int>(bodies.size())))];
        const std::size_t solid = 6 + static_cast<std::size_t>(random_.below(static_cast<int>(obstacles.size()) - 6));
        switch (random_.below(10)) {
        case 0:
            target.removeBody(body);
            addBody(target, world);
            addBody(target, world);
            break;
        case 1:
            target.removeObstacle(obstacles[solid]);
            break;
        case 2:
            (void)target.addObstacle(anyObstacle());
            break;
        case 3:
            (void)target.setPosition(body, random_.inBox(4.0));
            break;
        case 4:
            (void)target.setStyle(body, anyStyle());
            break;
        case 5:
            (void)target.setGravity(random_.uniform(5.0, 12.0) * glm::normalize(Vec3(0, -1, 0) + random_.inBox(0.3)));
            break;
        case 6:
            (void)target.setObstacleMotion(obstacles[solid], random_.inBox(1.0), random_.inBox(1.0));
            break;
        case 7:
            (void)target.setObstaclePose(obstacles[solid], random_.inBox(4.0), random_.rotation());
            break;
        case 8:
            (void)target.moveObstacle(obstacles[solid], random_.inBox(4.0), random_.rotation(), 1.0);
            break;
        default:
            (void)target.setVelocity(body, random_.inBox(8.0));
        }
    }

private:
    Style anyStyle() {
        Style style;
        style.restitution = random_.uniform(0.0, 1.0);
        style.min_squash = random_.uniform(0.3, 0.9);
        style.friction = random_.uniform(0.0, 1.0);
        style.corner_rule = random_.below(2) == 0 ? CornerRule::Blended : CornerRule::Queued;
        return style;
    }
    ObstacleDef anyObstacle() {
        ObstacleDef def;
        def.shape = shapes_[static_cast<std::size_t>(random_.below(static_cast<int>(shapes_.size())))];
        def.position = random_.inBox(4.5);
        def.rotation = random_.rotation();
        def.user_data = static_cast<std::uint64_t>(random_.below(1000));
        if (random_.below(3) == 0) {
            def.angular_velocity = random_.inBox(1.0);
        } else if (random_.below(2) == 0) {
            def.path = {{0.5, def.position + random_.inBox(1.0), random_.rotation()},
                        {1.1, def.position, def.rotation}};
            def.path_repeats = true;
        }
        return def;
    }
    template <class Target>
    void addBody(Target& target, const World& world) {
        for (int tries = 0; tries < 20; ++tries) {
            BodyDef def;
            def.shape = shapes_[static_cast<std::size_t>(random_.below(static_cast<int>(shapes_.size()) - 1))];
            def.style = anyStyle();
            def.position = random_.inBox(5.0);
            def.velocity = random_.inBox(6.0);
            def.rotation = random_.rotation();
            def.user_data = 0xfedcba9876543210ULL + static_cast<std::uint64_t>(random_.below(1000));
            if (!world.overlapOf(def)) {
                (void)target.addBody(def);
                return;
            }
        }
    }

    Random random_;
    int body_count_;
    std::vector<ShapePtr> shapes_ = busyShapes();
};

} // namespace elastoon
