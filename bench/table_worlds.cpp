// Table 6: whole worlds, stepped at 60 Hz, beside Bullet's.
#include "tables.h"
#include "worlds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace elastoon {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kWarmSteps = 60; // the soft bodies swell first, more than they do later
constexpr std::size_t kFewBodies = 100;
constexpr std::size_t kStepsInRun = 400;

struct Cell {
    std::string scene;
    std::size_t count;
    bool soft;
};

/// Ours, then the peer where there is one.
struct Figures {
    double ours = kNan, rigid = kNan, soft = kNan;
    double rigid_ratio = kNan, soft_ratio = kNan;
};

/// That all do the same: they stay inside; in the rain they go on bouncing, and keep about their size.
void judgeJob(const BenchWorld& scene, std::span<const std::unique_ptr<WorldContender>> contenders, Report& report,
              const std::string& name) {
    constexpr const char* kWhose[] = {"our", "the rigid", "the soft"};
    constexpr double kLeastHeight = 0.5; // of our bodies'
    constexpr double kMostRadius = 4.0 / 3.0; // of the shape's
    const double our_height = lookAround(scene, *contenders[0]).mean_height;
    for (std::size_t i = 0; i < contenders.size(); ++i) {
        const Crowdedness seen = lookAround(scene, *contenders[i]);
        report.errorAtMost(name + fmt::format(": share of {} bodies outside", kWhose[i]), 1.0 - seen.inside, 0.0);
        if (scene.name == "rain") {
            report.errorAtMost(name + fmt::format(": {} bodies' height, what half of ours is more", kWhose[i]),
                               std::max(0.0, kLeastHeight * our_height - seen.mean_height), 0.0);
        }
        const double most = kMostRadius * scene.shape->boundingRadius();
        report.errorAtMost(name + fmt::format(": {} bodies' radius, what is more than a third too much", kWhose[i]),
                           std::max(0.0, contenders[i]->meanRadius() - most), 0.0);
    }
}

Figures measure(const BenchWorld& scene, bool soft, const Effort& effort, Report& report, const std::string& name,
                std::uint64_t& hash) {
    using Staged = std::unique_ptr<WorldContender>;
    std::vector<std::function<Staged()>> stages{[&] { return ourWorld(scene, 1); }, [&] { return bulletWorld(scene); }};
    if (soft) {
        stages.emplace_back([&] { return bulletSoftWorld(scene); });
    }
    const auto many = [](WorldContender& contender, std::size_t steps) {
        for (std::size_t i = 0; i < steps; ++i) {
            contender.step();
        }
    };
    // All go through the same seconds of the scene, as what happens in them changes with time. Of many bodies the turns
    // follow one another; of few each is a run of its own, from the beginning on, and long enough that it is not spent
    // on bringing back what the one before has driven out of the caches and the branch predictors.
    const std::size_t count = scene.bodies.size();
    const bool begins_anew = count <= kFewBodies;
    const std::size_t steps = effort.quick ? 1 : begins_anew ? kStepsInRun : std::max<std::size_t>(8, 8000 / count);
    std::vector<Staged> contenders(stages.size());
    std::vector<Job> jobs;
    for (std::size_t i = 0; i < stages.size(); ++i) {
        const auto begin = [&, i] {
            contenders[i].reset(); // so that there are never two
            contenders[i] = stages[i]();
            many(*contenders[i], kWarmSteps);
        };
        begin();
        jobs.push_back({[&, i] { many(*contenders[i], steps); }, count * steps, nullptr});
        if (begins_anew) {
            jobs.back().prepare = begin;
        }
    }
    hash = contenders[0]->hash();
    const auto samples = interleave(jobs, effort);
    Figures figures{median(samples[0]), median(samples[1]), kNan, medianRatio(samples[1], samples[0]), kNan};
    if (soft) {
        figures.soft = median(samples[2]);
        figures.soft_ratio = medianRatio(samples[2], samples[0]);
    }
    judgeJob(scene, contenders, report, name);
    return figures;
}

void runCell(const Cell& cell, const Choice& choice, Report& report) {
    const std::string name = fmt::format("world {} {}", cell.scene, cell.count);
    if (!choice.wants(name)) {
        return;
    }
    const BenchWorld scene =
        benchWorld(cell.scene, choice.effort.quick ? std::min<std::size_t>(cell.count, 20) : cell.count);
    std::uint64_t hash = 0;
    const Figures figures = measure(scene, cell.soft, choice.effort, report, name, hash);
    report.add({name, figures.ours, figures.rigid, figures.rigid_ratio, figures.soft, figures.soft_ratio,
                fmt::format("  {:016x}", hash)});
    if (cell.scene == "rain" && cell.count == 10000) {
        report.expectAtLeast(name + ": times Bullet's rigid bodies", figures.rigid_ratio, 15.0);
    } else if (cell.scene == "rain") {
        report.expectAtLeast(name + ": times Bullet's soft bodies", figures.soft_ratio, 1000.0);
    } else if (cell.scene == "flight") {
        report.expectAtMost(name + ": ns a body and step", figures.ours, 20.0);
    }
}

} // namespace

void runWorldTable(const Choice& choice, Report& report) {
    report.begin({"6. Worlds of 258-vertex bodies at 60 Hz (ns a body and step, matrices written, one thread)",
                  {{"cell", "", 22},
                   {"Elastoon ns", "{:.1f}", 12},
                   {"rigid ns", "{:.0f}", 10},
                   {"ratio", "{:.1f}", 8},
                   {"soft ns", "{:.0f}", 10},
                   {"ratio", "{:.0f}", 8},
                   {"  hash", "", 18}},
                  {}});
    const Cell cells[] = {{"flight", 10000, false},  {"rain", 100, true},       {"rain", 10000, false},
                          {"ballpit", 10000, false}, {"pachinko", 1000, false}, {"corners", 1000, false}};
    for (const Cell& cell : cells) {
        runCell(cell, choice, report);
    }
}

} // namespace elastoon
