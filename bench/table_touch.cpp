// Table 3: the time of impact.
#include "casts.h"
#include "tables.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>

namespace elastoon {

namespace {

/// Height above the floor of the lowest vertex.
double heightAt(const CastScene& scene, const Cast& cast, double t) {
    const Pose pose = poseAt(cast.phase, *scene.body.shape, t);
    return pose.position.y - bruteReach(*scene.body.shape, pose, {0.0, -1.0, 0.0});
}

/// By looking at 64 times and bisecting the first that is below; infinite where none is.
double exactTouch(const CastScene& scene, const Cast& cast) {
    constexpr int kLooks = 64;
    for (int i = 1; i <= kLooks; ++i) {
        double high = kCastStep * i / kLooks;
        if (heightAt(scene, cast, high) > 0.0) {
            continue;
        }
        double low = kCastStep * (i - 1) / kLooks;
        for (int k = 0; k < 60; ++k) {
            const double middle = 0.5 * (low + high);
            (heightAt(scene, cast, middle) > 0.0 ? low : high) = middle;
        }
        return low;
    }
    return std::numeric_limits<double>::infinity();
}

constexpr std::size_t kOurs = 3;

struct TouchErrors {
    double time = 0.0; ///< the largest, as a share of the step
    double gap = 0.0;  ///< the furthest off the floor or in it at the reported time, m
    double depth = 0.0; ///< the deepest in it, m
    double wrong = 0.0; ///< hits that are none, or are missed
};

TouchErrors errorsOf(const CastScene& scene, const std::vector<double>& times) {
    TouchErrors errors;
    for (std::size_t i = 0; i < times.size(); ++i) {
        const double exact = exactTouch(scene, scene.casts[i]);
        if (std::isinf(times[i]) != std::isinf(exact)) {
            errors.wrong += 1.0;
        } else if (!std::isinf(exact)) {
            errors.time = worst(errors.time, std::fabs(times[i] - exact) / kCastStep);
            const double height = heightAt(scene, scene.casts[i], times[i]);
            errors.gap = worst(errors.gap, std::fabs(height));
            errors.depth = worst(errors.depth, -height);
        }
    }
    return errors;
}

void runCell(const BenchBody& body, bool hits, const Choice& choice, Report& report) {
    const std::string cell = fmt::format("touch {} {}", hits ? "hit" : "miss", body.name);
    if (!choice.wants(cell)) {
        return;
    }
    const int count = choice.effort.quick ? 100 : 400;
    std::map<CastMotion, CastScene> scenes;
    for (const CastMotion motion : {CastMotion::Flight, CastMotion::Lively, CastMotion::Rigid}) {
        scenes.emplace(motion, castScene(body, motion, hits, count));
    }
    CastContenders contenders;
    addOurCasts(body, contenders);
    addBulletCasts(body, contenders);
    std::vector<std::vector<double>> times(contenders.size(), std::vector<double>(static_cast<std::size_t>(count)));
    std::vector<Job> jobs;
    for (std::size_t i = 0; i < contenders.size(); ++i) {
        CastContender* contender = contenders[i].get();
        const std::vector<Cast>& casts = scenes.at(contender->motion()).casts;
        jobs.push_back({[=, &casts, &times] { contender->run(casts, times[i]); }, casts.size()});
        jobs.push_back({[=, &casts] { contender->bakeAll(casts); }, casts.size()});
    }
    const auto samples = interleave(jobs, choice.effort);
    for (std::size_t i = 0; i < contenders.size(); ++i) {
        const CastContender& contender = *contenders[i];
        const TouchErrors errors = errorsOf(scenes.at(contender.motion()), times[i]);
        const auto query = difference(samples[2 * i], samples[2 * i + 1]);
        report.add({cell, contender.name(), contender.bakes() ? median(query) : median(samples[2 * i]),
                    contender.bakes() ? median(samples[2 * i + 1]) : std::nan(""), median(samples[2 * i]),
                    medianRatio(samples[2 * i], samples[0]), errors.time, errors.gap, errors.wrong});
        if (i < kOurs) {
            // What counts as a touch is 1e-8 of the length away.
            report.errorAtMost(cell + ": gap of " + contender.name(), errors.gap, 1.1e-8);
            report.errorAtMost(cell + ": depth of " + contender.name(), errors.depth, 1e-12);
            report.errorAtMost(cell + ": wrong answers of " + contender.name(), errors.wrong, 0.0);
        }
    }
    if (cell == "touch hit sphere258") {
        report.expectAtMost(cell + ": ns a cast, flight", median(samples[0]), 4000.0);
        report.expectAtMost(cell + ": ns a cast, lively", median(samples[2]), 4000.0);
    }
}

} // namespace

void runTouchTable(const Choice& choice, Report& report) {
    report.begin({"3. Time of impact with a box floor within a step of 1/60 s (ns a cast; ratios to Elastoon flight)",
                  {{"cell", "", 22},
                   {"contender", "", 19},
                   {"cast ns", "{:.0f}", 9},
                   {"baking ns", "{:.0f}", 10},
                   {"sum ns", "{:.0f}", 8},
                   {"sum ratio", "{:.2f}", 10},
                   {"time error", "{:.1e}", 11},
                   {"gap there", "{:.1e}", 10},
                   {"wrong", "{:.0f}", 7}},
                  {}});
    for (const bool hits : {true, false}) {
        for (const BenchBody& body : benchBodies()) {
            runCell(body, hits, choice, report);
        }
    }
}

} // namespace elastoon
