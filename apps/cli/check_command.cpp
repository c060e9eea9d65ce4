// elastoon check: runs a scene while the oracle watches.
#include "commands.h"
#include "oracle.h"

#include <fmt/format.h>

#include <memory>

namespace elastoon {

namespace {

struct CheckOptions {
    std::string scene, style;
    double fps = 240.0;
    double duration = -1.0;
};

bool printRow(const char* what, const Worst& worst, double bound, const char* unit) {
    const bool fine = worst.value <= bound;
    fmt::print("{:<4} {:<28} {:>10.3g} {} (bound {:g})", fine ? "ok" : "BAD", what, worst.value, unit, bound);
    if (worst.value > 0.0) {
        fmt::print("  at {:.4f} s, {}{}{}", worst.time, worst.body, worst.other.empty() ? "" : " on ", worst.other);
    }
    fmt::print("\n");
    return fine;
}

void check(const CheckOptions& options) {
    const Scene scene = loadScene(options.scene, options.style);
    const double duration = options.duration < 0.0 ? scene.duration : options.duration;
    const Performance performance = perform(scene, duration);
    const OracleReport report = inspect(scene, performance.staged, performance.timeline, options.fps);
    fmt::print("{}: {} bodies, {:g} s, {} poses looked at\n", options.scene, scene.bodies.size(), duration,
               report.poses);
    printRow("deepest in a plane", report.depth, OracleReport::kMostDepth, "L");
    printRow("deepest in a solid", report.solid_depth, OracleReport::kMostSolidDepth, "L");
    printRow("widest gap in contact", report.gap, OracleReport::kMostGap, "L");
    printRow("volume error", report.volume_error, OracleReport::kMostVolumeError, " ");
    printRow("jump between phases", report.jump, OracleReport::kMostJump, "L");
    fmt::print("{:<4} {:<28} {:>10}\n", report.not_finite == 0 ? "ok" : "BAD", "values that are not finite",
               report.not_finite);
    if (!report.withinBounds()) {
        fail({"a bound is broken", options.scene});
    }
}

} // namespace

void addCheckCommand(CLI::App& app) {
    auto options = std::make_shared<CheckOptions>();
    CLI::App* command = app.add_subcommand("check", "Run a scene while an independent oracle watches");
    command->add_option("scene", options->scene, "Scene file (.json)")->required();
    command->add_option("--fps", options->fps, "Looks per second besides those at impacts")
        ->check(between(1.0, 100000.0))
        ->capture_default_str();
    command->add_option("--duration", options->duration, "Seconds; default: the scene's")->check(between(0.0, 86400.0));
    addStyleOption(*command, options->style);
    command->callback([options] { check(*options); });
}

} // namespace elastoon
