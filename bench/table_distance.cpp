// Tables 1 and 2: distances along a coherent motion, and at random poses.
#include "contender.h"
#include "reference.h"
#include "tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace elastoon {

namespace {

constexpr double kMostError = 1e-9; // of the size, which is 1 m

/// What one contender did in one cell.
struct Outcome {
    std::vector<double> query, baking, sum; ///< ns of each round
    double error = 0.0;                     ///< the largest
    int unanswered = 0;
};

/// Infinite where the reference is not sure of itself: then nobody's error holds.
std::vector<double> exactDistances(const DistanceScene& scene) {
    std::vector<double> exact;
    for (const Pose& pose : scene.poses) {
        const ReferenceDistance found = referenceDistance(*scene.body.shape, pose, *scene.other, scene.other_pose);
        exact.push_back(found.slack < 1e-3 * kMostError ? found.distance : std::numeric_limits<double>::infinity());
    }
    return exact;
}

std::vector<Outcome> measure(const DistanceScene& scene, const DistanceContenders& contenders, const Effort& effort) {
    const std::size_t count = scene.poses.size();
    std::vector<std::vector<double>> distances(contenders.size(), std::vector<double>(count));
    std::vector<Job> jobs;
    for (std::size_t i = 0; i < contenders.size(); ++i) {
        DistanceContender* contender = contenders[i].get();
        jobs.push_back({[=, &scene, &distances] { contender->run(scene.poses, distances[i]); }, count});
        if (contender->bakes()) {
            jobs.push_back({[=, &scene] { contender->bakeAll(scene.poses); }, count});
        }
    }
    auto samples = interleave(jobs, effort);
    const std::vector<double> exact = exactDistances(scene);
    std::vector<Outcome> outcomes(contenders.size());
    std::size_t job = 0;
    for (std::size_t i = 0; i < contenders.size(); ++i) {
        Outcome& outcome = outcomes[i];
        outcome.sum = std::move(samples[job++]);
        outcome.baking = contenders[i]->bakes() ? std::move(samples[job++]) : std::vector(outcome.sum.size(), 0.0);
        outcome.query = difference(outcome.sum, outcome.baking);
        for (std::size_t k = 0; k < count; ++k) {
            if (std::isnan(distances[i][k])) {
                ++outcome.unanswered;
            } else {
                outcome.error = worst(outcome.error, std::fabs(distances[i][k] - exact[k]));
            }
        }
    }
    return outcomes;
}

/// Judges the default method against each library, at the setting of it that does best.
void judgePeers(const DistanceScene& scene, const DistanceContenders& contenders, const std::vector<Outcome>& outcomes,
                Report& report) {
    const bool is_main_cell = scene.cell == "coherent floor sphere258";
    if (scene.coherent && !is_main_cell) {
        return;
    }
    std::map<std::string, double> best;
    for (std::size_t i = 2; i < contenders.size(); ++i) {
        const std::string library = contenders[i]->name().substr(0, contenders[i]->name().find(' '));
        const double ratio = medianRatio(outcomes[i].sum, outcomes[0].sum);
        const auto [place, is_new] = best.emplace(library, ratio);
        place->second = is_new ? ratio : std::min(place->second, ratio);
    }
    for (const auto& [library, ratio] : best) {
        const double limit = !scene.coherent ? 1.0 : library == "libccd" ? 6.0 : 12.0;
        report.expectAtLeast(fmt::format("{}: {} over Elastoon V-Clip", scene.cell, library), ratio, limit);
    }
}

void addRows(const DistanceScene& scene, const DistanceContenders& contenders, const std::vector<Outcome>& outcomes,
             Report& report) {
    for (std::size_t i = 0; i < contenders.size(); ++i) {
        const Outcome& outcome = outcomes[i];
        const double baking = contenders[i]->bakes() ? median(outcome.baking) : std::nan("");
        report.add({scene.cell, contenders[i]->name(), median(outcome.query), baking, median(outcome.sum),
                    medianRatio(outcome.query, outcomes[0].sum), medianRatio(outcome.sum, outcomes[0].sum),
                    outcome.error, static_cast<double>(outcome.unanswered)});
    }
    for (std::size_t i = 0; i < 2; ++i) {
        const Outcome& outcome = outcomes[i];
        const double error = outcome.unanswered > 0 ? std::numeric_limits<double>::infinity() : outcome.error;
        report.errorAtMost(fmt::format("{}: error of {}", scene.cell, contenders[i]->name()), error, kMostError);
    }
}

void runTable(const char* title, bool coherent, const Choice& choice, Report& report) {
    report.begin({title,
                  {{"cell", "", 27},
                   {"contender", "", 18},
                   {"query ns", "{:.0f}", 9},
                   {"baking ns", "{:.0f}", 10},
                   {"sum ns", "{:.0f}", 8},
                   {"query ratio", "{:.2f}", 12},
                   {"sum ratio", "{:.2f}", 10},
                   {"max error", "{:.1e}", 10},
                   {"no answer", "{:.0f}", 10}},
                  {}});
    std::map<std::string, double> costs;
    for (const bool on_floor : {true, false}) {
        for (const BenchBody& body : benchBodies()) {
            const DistanceScene scene = coherent ? coherentScene(body, on_floor, choice.effort.quick)
                                                 : randomScene(body, on_floor, choice.effort.quick);
            if (!choice.wants(scene.cell)) {
                continue;
            }
            DistanceContenders contenders;
            addOurs(scene, contenders);
            addFcl(scene, contenders);
            addBullet(scene, contenders);
            addCcd(scene, contenders);
            const std::vector<Outcome> outcomes = measure(scene, contenders, choice.effort);
            addRows(scene, contenders, outcomes, report);
            judgePeers(scene, contenders, outcomes, report);
            costs[scene.cell] = median(outcomes[0].sum);
        }
    }
    const auto small = costs.find("coherent floor sphere66");
    const auto large = costs.find("coherent floor sphere1026");
    if (small != costs.end() && large != costs.end()) {
        report.expectAtMost("coherent floor: 1026 vertices over 66", large->second / small->second, 1.8);
    }
}

} // namespace

void runDistanceTables(const Choice& choice, Report& report) {
    runTable(
        "1. Distance, coherent motion of a deforming body (ns a query; ratios to Elastoon V-Clip; errors in m, size 1)",
        true, choice, report);
    runTable("2. Distance, random poses, no seeds", false, choice, report);
}

} // namespace elastoon
