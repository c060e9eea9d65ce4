// Table 4: how far a deformed body reaches towards a half-space.
#include "contact.h"
#include "poses.h"
#include "tables.h"

#include <cmath>

namespace elastoon {

namespace {

struct SupportScene {
    std::string cell;
    std::vector<Pose> poses;
    std::vector<Vec3> directions;
};

SupportScene supportScene(const BenchBody& body, bool coherent, bool quick) {
    SupportScene scene{(coherent ? "support coherent " : "support random ") + body.name,
                       (coherent ? coherentScene(body, true, quick) : randomScene(body, true, quick)).poses,
                       {}};
    BenchRandom random(29);
    for (std::size_t i = 0; i < scene.poses.size(); ++i) {
        scene.directions.push_back(coherent ? Vec3(0.0, -1.0, 0.0) : random.direction());
    }
    return scene;
}

void runCell(const BenchBody& body, bool coherent, const Choice& choice, Report& report) {
    const SupportScene scene = supportScene(body, coherent, choice.effort.quick);
    if (!choice.wants(scene.cell)) {
        return;
    }
    const std::size_t count = scene.poses.size();
    // Enough of them that the clock does not count.
    const std::size_t repeats = choice.effort.quick ? 1 : 10;
    std::vector<double> ours(count);
    std::vector<double> brute(count);
    const auto repeat = [&](auto&& reach, std::vector<double>& out) {
        for (std::size_t k = 0; k < repeats; ++k) {
            for (std::size_t i = 0; i < count; ++i) {
                out[i] = reach(*body.shape, scene.poses[i], scene.directions[i]);
            }
        }
    };
    const Job jobs[] = {{[&] { repeat(reachTowards, ours); }, repeats * count},
                        {[&] { repeat(bruteReach, brute); }, repeats * count}};
    const auto samples = interleave(jobs, choice.effort);
    double error = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        error = worst(error, std::fabs(ours[i] - brute[i]));
    }
    report.add({scene.cell, median(samples[0]), median(samples[1]), medianRatio(samples[1], samples[0]), error});
    report.errorAtMost(scene.cell + ": error", error, 1e-12);
    if (scene.cell == "support coherent sphere258") {
        report.expectAtMost("support coherent sphere258: ns a query", median(samples[0]), 30.0);
    }
}

} // namespace

void runSupportTable(const Choice& choice, Report& report) {
    report.begin({"4. Half-space support of a deformed body (ns a query; brute force looks at all vertices)",
                  {{"cell", "", 30},
                   {"Elastoon ns", "{:.1f}", 12},
                   {"brute ns", "{:.1f}", 10},
                   {"ratio", "{:.2f}", 8},
                   {"max error", "{:.1e}", 10}},
                  {}});
    for (const bool coherent : {true, false}) {
        for (const BenchBody& body : benchBodies()) {
            runCell(body, coherent, choice, report);
        }
    }
}

} // namespace elastoon
