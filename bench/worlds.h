// Whole worlds for the benchmark, and what steps them: the library, and Bullet's rigid and soft bodies.
#pragma once

#include "bench_worlds.h"

#include <memory>
#include <string>
#include <vector>

namespace elastoon {

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
    /// m, of the vertices from their body's centre; 0 where bodies keep their size anyhow.
    [[nodiscard]] virtual double meanRadius() const { return 0.0; }
    [[nodiscard]] virtual std::uint64_t hash() const { return 0; }
};

[[nodiscard]] std::unique_ptr<WorldContender> ourWorld(const BenchWorld& scene, int threads);
[[nodiscard]] std::unique_ptr<WorldContender> bulletWorld(const BenchWorld& scene);
[[nodiscard]] std::unique_ptr<WorldContender> bulletSoftWorld(const BenchWorld& scene);

[[nodiscard]] Crowdedness lookAround(const BenchWorld& scene, const WorldContender& contender);

} // namespace elastoon
