// elastoon simulate: runs a scene, writes what it did, prints counts, speed and the state's hash.
#include "commands.h"
#include "gltf_export.h"
#include "parallel.h"
#include "progress.h"
#include "recording.h"
#include "video.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

namespace elastoon {

namespace {

struct SimulateOptions {
    std::string scene, style;
    double fps = 60.0;
    double duration = -1.0;
    int threads = 1;
    std::vector<std::string> outputs;
    std::string events;
};

/// Wrong endings are bad use, and are told before the work, not after it.
void checkOutputs(const SimulateOptions& options) {
    for (const std::string& path : options.outputs) {
        const std::string ending = endingOf(path);
        if (ending != ".csv" && ending != ".json" && ending != ".glb") {
            fail({"the ending must be .csv, .json or .glb", path}, kExitBadUse);
        }
    }
    if (!options.events.empty() && endingOf(options.events) != ".csv") {
        fail({"the ending must be .csv", options.events}, kExitBadUse);
    }
}

Status write(const SimulateOptions& options, const Scene& scene, const Performance& performance, double duration,
             const std::string& path) {
    const std::string ending = endingOf(path);
    if (ending == ".csv") {
        return writePoseCsv(scene, performance.staged, performance.timeline, options.fps, duration, path);
    }
    if (ending == ".json") {
        return writeRecordingJson(scene, performance.staged, performance.timeline, options.fps, duration, path);
    }
    return writeGlb(scene, performance.staged, performance.timeline, options.fps, path);
}

/// Steps the scene at the asked rate, the last step ending at `duration`. Returns the seconds spent in steps.
double run(const SimulateOptions& options, double duration, Performance& performance, long& steps) {
    World& world = performance.staged.world;
    performance.timeline.begin(world);
    Progress progress("simulate", duration);
    double seconds = 0.0;
    while (world.time() < duration) {
        ++steps;
        const double next = std::min(static_cast<double>(steps) / options.fps, duration);
        const auto begin = std::chrono::steady_clock::now();
        world.step(std::max(0.0, next - world.time()));
        seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        performance.timeline.capture(world);
        progress.at(next);
        if (interrupted()) {
            fail({"interrupted; nothing was written", ""});
        }
        if (next >= duration) {
            break;
        }
    }
    return seconds;
}

void simulate(const SimulateOptions& options) {
    checkOutputs(options);
    const Scene scene = loadScene(options.scene, options.style);
    const double duration = options.duration < 0.0 ? scene.duration : options.duration;
    Performance performance{orFail(stage(scene, onThreads(options.threads)), kExitBadUse), {}};
    long steps = 0;
    const double seconds = run(options, duration, performance, steps);
    for (const std::string& path : options.outputs) {
        orFail(write(options, scene, performance, duration, path));
        fmt::print("wrote {}\n", path);
    }
    if (!options.events.empty()) {
        orFail(writeEventCsv(scene, performance.staged, performance.timeline, options.events));
        fmt::print("wrote {}\n", options.events);
    }
    const auto& events = performance.timeline.events();
    const auto impacts =
        std::count_if(events.begin(), events.end(), [](const Event& event) { return event.type == EventType::Impact; });
    fmt::print("bodies={} impacts={} steps={} steps/s={:.0f}\nhash={:016x}\n", scene.bodies.size(), impacts, steps,
               static_cast<double>(steps) / std::max(seconds, 1e-9), performance.staged.world.stateHash());
}

} // namespace

void addSimulateCommand(CLI::App& app) {
    auto options = std::make_shared<SimulateOptions>();
    CLI::App* command = app.add_subcommand("simulate", "Run a scene; write poses, events, or an animated .glb");
    command->add_option("scene", options->scene, "Scene file (.json)")->required();
    command->add_option("--fps", options->fps, "Steps, and poses written, per second")
        ->check(between(0.1, 100000.0))
        ->capture_default_str();
    command->add_option("--duration", options->duration, "Seconds; default: the scene's")->check(between(0.0, 86400.0));
    command->add_option("--threads", options->threads, "Threads; the results do not depend on it")
        ->check(between(1, 256))
        ->capture_default_str();
    command->add_option("-o,--output", options->outputs,
                        "File to write, by its ending: .csv poses, .json recording, .glb animation; may be repeated");
    command->add_option("--events", options->events, "Event file to write (.csv)");
    addStyleOption(*command, options->style);
    command->callback([options] { simulate(*options); });
}

} // namespace elastoon
