// See worlds.h: the library's own stepping.
#include "worlds.h"

#include "parallel.h"

#include <algorithm>
#include <cmath>

namespace elastoon {

namespace {

constexpr double kStep = 1.0 / 60.0;

class OurWorld : public WorldContender {
public:
    OurWorld(const BenchWorld& scene, int threads)
        : world_(stageBenchWorld(scene, {.gravity = scene.gravity, .parallel_for = onThreads(threads)}, bodies_)) {}
    void step() override {
        world_.step(kStep);
        matrices_ = world_.matrices();
    }
    [[nodiscard]] std::vector<Vec3> places() const override {
        std::vector<Vec3> places;
        for (const BodyId body : bodies_) {
            places.push_back(world_.pose(body).position);
        }
        return places;
    }
    [[nodiscard]] std::uint64_t hash() const override { return world_.stateHash(); }

private:
    std::vector<BodyId> bodies_;
    World world_;
    std::span<const float> matrices_;
};

} // namespace

std::unique_ptr<WorldContender> ourWorld(const BenchWorld& scene, int threads) {
    return std::make_unique<OurWorld>(scene, threads);
}

Crowdedness lookAround(const BenchWorld& scene, const WorldContender& contender) {
    Crowdedness seen;
    const std::vector<Vec3> places = contender.places();
    for (const Vec3& place : places) {
        const bool between = std::fabs(place.x) < scene.half && std::fabs(place.z) < scene.half;
        seen.inside += scene.half == 0.0 || (between && place.y > 0.0) ? 1.0 : 0.0;
        seen.mean_height += place.y;
    }
    const double count = std::max(1.0, static_cast<double>(places.size()));
    return {seen.inside / count, seen.mean_height / count};
}

} // namespace elastoon
