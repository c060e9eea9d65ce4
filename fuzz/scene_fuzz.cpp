// libFuzzer target: bytes as a scene file; what is read can be staged and stepped, and all poses stay finite.
// scripts/fuzz.sh runs it.
#include "bytes.h"
#include "elastoon/scene.h"

#include <cmath>
#include <cstdint>
#include <string_view>

namespace {

bool isFinite(const elastoon::Pose& pose) {
    const elastoon::Quat& q = pose.orientation;
    return std::isfinite(glm::length(pose.position)) && std::isfinite(q.x + q.y + q.z + q.w) &&
           std::isfinite(pose.stretch) && pose.stretch > 0.0;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto scene = elastoon::parseScene(std::string_view(reinterpret_cast<const char*>(data), size));
    if (!scene) {
        elastoon::demand(!scene.error().message.empty(), "an error without a message");
        return 0;
    }
    // Large scenes are no finding, only slow.
    if (scene.value().bodies.size() > 8 || scene.value().obstacles.size() > 8) {
        return 0;
    }
    auto staged = elastoon::stage(scene.value());
    elastoon::demand(staged.ok(), "a scene that was read cannot be staged");
    elastoon::World& world = staged.value().world;
    for (const double dt : {0.01, 0.1, 0.0, 1.0 / 60.0, 0.5}) {
        world.step(dt);
        for (const elastoon::BodyId body : staged.value().bodies) {
            elastoon::demand(isFinite(world.pose(body)), "a pose that is not finite");
        }
    }
    return 0;
}
