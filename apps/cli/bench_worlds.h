// The worlds of the benchmark: seeded, of any number of bodies.
#pragma once

#include "elastoon/world.h"

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
/// The library's world of the scene, each body moved up until it has room; `bodies` gets them.
[[nodiscard]] World stageBenchWorld(const BenchWorld& scene, const WorldDef& def, std::vector<BodyId>& bodies);

} // namespace elastoon
