// Whole worlds for the benchmark, and what steps them: the library, and Bullet's rigid and soft bodies.
#pragma once

#include "elastoon/world.h"

#include <memory>
#include <string>
#include <vector>

namespace elastoon {

/// A room without a roof, its floor at y = 0, with bodies of one shape that do not meet each other.
struct BenchWorld {
    std::string name;
    Vec3 gravity{0.0, -9.81, 0.0};
    double half = 0.0; ///< m, of the floor; 0: no room
    ShapePtr shape;
    Style style;
    std::vector<BodyDef> bodies;
    std::vector<ObstacleDef> obstacles; ///< boxes, besides the room
};

/// flight: nothing to meet. rain: bodies that bounce for ever among tilted boxes. ballpit: all at rest.
/// pachinko: bodies that fall through a forest of posts. corners: a small room of many boxes, so that most bodies touch
/// two things at a time.
[[nodiscard]] std::vector<std::string> benchWorldNames();
[[nodiscard]] BenchWorld benchWorld(const std::string& name, std::size_t count);

/// What became of the bodies, for judging whether a contender does the job.
struct Crowdedness {
    double inside = 0.0; ///< share of the bodies above the floor and between the walls
    double mean_height = 0.0; ///< m
};

class WorldContender {
public:
    virtual ~WorldContender() = default;
    /// By 1/60 s; every body's matrix is written.
    virtual void step() = 0;
    [[nodiscard]] virtual std::vector<Vec3> places() const = 0;
    [[nodiscard]] virtual std::uint64_t hash() const { return 0; }
};

[[nodiscard]] std::unique_ptr<WorldContender> ourWorld(const BenchWorld& scene, int threads);
[[nodiscard]] std::unique_ptr<WorldContender> bulletWorld(const BenchWorld& scene);
[[nodiscard]] std::unique_ptr<WorldContender> bulletSoftWorld(const BenchWorld& scene);

[[nodiscard]] Crowdedness lookAround(const BenchWorld& scene, const WorldContender& contender);

} // namespace elastoon
