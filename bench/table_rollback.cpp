// Table 8: what a networked game does when an input comes late: back by eight frames, and through them again.
#include "tables.h"
#include "worlds.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace elastoon {

namespace {

constexpr double kStep = 1.0 / 60.0;
constexpr std::size_t kBodies = 100;
constexpr std::size_t kFrames = 8;
constexpr int kWarmSteps = 60;
/// A tenth of a frame at 60 Hz.
constexpr double kMostMicroseconds = 1e6 * kStep / 10.0;

/// A world that keeps a snapshot of each of its last frames.
class RollingWorld {
public:
    explicit RollingWorld(const BenchWorld& scene)
        : world_(stageBenchWorld(scene, {.gravity = scene.gravity, .parallel_for = {}}, bodies_)) {
        for (int i = 0; i < kWarmSteps; ++i) {
            frame();
        }
    }
    void frame() {
        save();
        step();
    }
    void save() { world_.snapshotInto(before_[frame_ % kFrames]); }
    void step() {
        world_.step(kStep);
        ++frame_;
    }
    /// To what the frame eight ago began with.
    void goBack() {
        frame_ -= kFrames;
        if (!world_.restore(before_[frame_ % kFrames])) {
            throw std::runtime_error("a snapshot of this world must fit it");
        }
    }
    void rollBack() {
        goBack();
        for (std::size_t i = 0; i < kFrames; ++i) {
            frame();
        }
    }
    [[nodiscard]] std::uint64_t hash() const { return world_.stateHash(); }
    [[nodiscard]] std::size_t bytes() const { return before_.front().size(); }

private:
    std::vector<BodyId> bodies_;
    World world_;
    std::size_t frame_ = 0;
    std::array<std::vector<std::byte>, kFrames> before_;
};

void runCell(const std::string& scene_name, const Choice& choice, Report& report) {
    const std::string name = fmt::format("rollback {} {}", scene_name, kBodies);
    if (!choice.wants(name)) {
        return;
    }
    const BenchWorld scene = benchWorld(scene_name, kBodies);
    RollingWorld stepped(scene);
    RollingWorld saved(scene);
    RollingWorld rolled(scene);
    const std::uint64_t before = rolled.hash();
    const auto samples = interleave(std::array<Job, 3>{Job{[&] { stepped.step(); }, 1}, Job{[&] { saved.save(); }, 1},
                                                       Job{[&] { rolled.rollBack(); }, 1}},
                                    choice.effort);
    const double rollback = 1e-3 * median(samples[2]);
    report.add({name, 1e-3 * median(samples[0]), 1e-3 * median(samples[1]), rollback, rollback / kMostMicroseconds,
                static_cast<double>(saved.bytes()) / static_cast<double>(kBodies)});
    report.errorAtMost(name + ": the frames gone through again differ", rolled.hash() == before ? 0.0 : 1.0, 0.0);
    if (scene_name == "rain") {
        report.expectAtMost(name + ": microseconds of eight frames", rollback, kMostMicroseconds);
    }
}

} // namespace

void runRollbackTable(const Choice& choice, Report& report) {
    report.begin(
        {"8. Back by eight frames and through them again, a snapshot at each; a tenth of a 60 Hz frame is 1667 us",
         {{"cell", "", 22},
          {"step us", "{:.1f}", 10},
          {"snapshot us", "{:.1f}", 13},
          {"rollback us", "{:.1f}", 13},
          {"share of it", "{:.3f}", 13},
          {"snapshot: bytes a body", "{:.0f}", 24}},
         {}});
    for (const char* scene : {"rain", "pachinko", "corners", "ballpit"}) {
        runCell(scene, choice, report);
    }
}

} // namespace elastoon
