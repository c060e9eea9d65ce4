// elastoon bench: how fast the library steps the benchmark's worlds here, and that it gives the bits it should.
#include "bench_hashes.h"
#include "bench_worlds.h"
#include "commands.h"
#include "output_file.h"
#include "parallel.h"
#include "progress.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <memory>
#include <optional>
#include <set>

namespace elastoon {

namespace {

constexpr double kStep = 1.0 / 60.0;
/// Before anything is measured, and until the hash is taken.
constexpr int kWarmSteps = 60;
/// From then on a scene is played once more: later much of it is at rest.
constexpr long kMostSteps = 600;

struct BenchOptions {
    std::vector<std::string> scenes;
    std::size_t bodies = 0;
    int threads = 1;
    double seconds = 1.0;
    std::string csv, commit;
    bool validate_hash = false;
};

struct Row {
    std::string scene;
    std::size_t bodies = 0;
    double steps_per_second = 0.0, nanoseconds = 0.0, bytes = 0.0;
    std::uint64_t hash = 0;
    StepProfile spent;
};

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double bytesInUse() {
    const struct mallinfo2 info = mallinfo2();
    return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

void add(StepProfile& sum, const StepProfile& step) {
    sum.prepare += step.prepare;
    sum.advance += step.advance;
    sum.follow_paths += step.follow_paths;
    sum.sort_events += step.sort_events;
    sum.matrices += step.matrices;
    sum.advanced += step.advanced;
}

Row measure(const BenchScene& kind, const BenchOptions& options) {
    Row row;
    row.scene = kind.name;
    row.bodies = options.bodies > 0 ? options.bodies : kind.bodies;
    const BenchWorld scene = benchWorld(kind.name, row.bodies);
    std::vector<BodyId> bodies;
    const double before = bytesInUse();
    World world = stageBenchWorld(
        scene, {.gravity = scene.gravity, .parallel_for = onThreads(options.threads), .clock = now}, bodies);
    const auto step = [&] {
        world.step(kStep);
        (void)world.matrices();
        if (interrupted()) {
            fail({"interrupted; nothing was written", ""});
        }
    };
    for (int i = 0; i < kWarmSteps; ++i) {
        step();
    }
    row.bytes = (bytesInUse() - before) / static_cast<double>(row.bodies);
    row.hash = world.stateHash();
    const std::vector<std::byte> start = world.snapshot();
    double played = 0.0;
    long steps = 0;
    do {
        if (steps > 0 && steps % kMostSteps == 0 && !world.restore(start).ok()) {
            fail({"its own snapshot could not be restored", row.scene});
        }
        const double begin = now();
        step();
        played += now() - begin;
        add(row.spent, world.profile());
        ++steps;
    } while (played < options.seconds);
    const double seconds = played / static_cast<double>(steps);
    row.steps_per_second = 1.0 / seconds;
    row.nanoseconds = 1e9 * seconds / static_cast<double>(row.bodies);
    row.spent.advanced /= static_cast<std::size_t>(steps);
    return row;
}

void print(const Row& row, int threads) {
    fmt::print("{:<10} {:>9} {:>7} {:>10.1f} {:>12.1f} {:>12.0f}  {:016x}\n", row.scene, row.bodies, threads,
               row.steps_per_second, row.nanoseconds, row.bytes, row.hash);
    const StepProfile& spent = row.spent;
    const double all =
        std::max(1e-12, spent.prepare + spent.advance + spent.follow_paths + spent.sort_events + spent.matrices);
    fmt::print("           advance {:.0f} %, matrices {:.0f} %, sort events {:.0f} %, prepare {:.0f} %; bodies with "
               "something to do: {} a step\n",
               100.0 * spent.advance / all, 100.0 * spent.matrices / all, 100.0 * spent.sort_events / all,
               100.0 * (spent.prepare + spent.follow_paths) / all, spent.advanced);
    std::fflush(stdout);
}

std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        if (const auto colon = line.find(": "); line.starts_with("model name") && colon != std::string::npos) {
            return line.substr(colon + 2);
        }
    }
    return "unknown";
}

void writeCsv(OutputFile& file, const std::vector<Row>& rows, const BenchOptions& options) {
    std::ofstream stream(file.temporaryPath());
    stream << "scene,bodies,threads,steps_per_s,ns_per_body_step,bytes_per_body,hash,processor,compiler,flags,commit\n";
    for (const Row& row : rows) {
        stream << fmt::format("{},{},{},{:.2f},{:.2f},{:.0f},{:016x},\"{}\",\"{}\",\"{}\",\"{}\"\n", row.scene,
                              row.bodies, options.threads, row.steps_per_second, row.nanoseconds, row.bytes, row.hash,
                              processor(), __VERSION__, ELASTOON_FLAGS, options.commit);
    }
    stream.close();
    const Status committed = stream ? file.commit() : Error{"cannot write: is the disk full?", file.temporaryPath()};
    if (!committed) {
        fail(committed.error());
    }
    fmt::print("wrote {}\n", options.csv);
}

/// The scenes that were asked for, in their order; all where none was.
std::vector<BenchScene> chosen(const BenchOptions& options) {
    std::vector<BenchScene> scenes;
    for (const BenchScene& scene : kBenchScenes) {
        if (options.scenes.empty() ||
            std::find(options.scenes.begin(), options.scenes.end(), scene.name) != options.scenes.end()) {
            scenes.push_back(scene);
        }
    }
    return scenes;
}

void bench(const BenchOptions& options) {
    if (options.validate_hash && options.bodies > 0) {
        fail({"the hashes are those of the usual numbers of bodies: leave --bodies out", "--validate-hash"},
             kExitBadUse);
    }
    // A place that cannot be written should be known before the work.
    std::optional<OutputFile> file;
    if (!options.csv.empty()) {
        file.emplace(orFail(OutputFile::create(options.csv)));
    }
    fmt::print("{:<10} {:>9} {:>7} {:>10} {:>12} {:>12}  {}\n", "scene", "bodies", "threads", "steps/s", "ns/body/step",
               "bytes/body", "hash");
    std::vector<Row> rows;
    int differ = 0;
    for (const BenchScene& scene : chosen(options)) {
        rows.push_back(measure(scene, options));
        print(rows.back(), options.threads);
        if (options.validate_hash) {
            const bool met = rows.back().hash == scene.hash;
            fmt::print("           hash {}\n", met ? "ok" : fmt::format("DIFFERS from {:016x}", scene.hash));
            differ += met ? 0 : 1;
        }
    }
    if (file) {
        writeCsv(*file, rows, options);
    }
    if (differ > 0) {
        fail({fmt::format("{} of {} hashes differ", differ, rows.size()), "bench"});
    }
}

} // namespace

void addBenchCommand(CLI::App& app) {
    auto options = std::make_shared<BenchOptions>();
    options->commit = ELASTOON_VERSION;
    CLI::App* command = app.add_subcommand("bench", "Measure how fast the benchmark's worlds are stepped here");
    std::set<std::string> names;
    for (const BenchScene& scene : kBenchScenes) {
        names.insert(scene.name);
    }
    command->add_option("scenes", options->scenes, "Which; default: all")->check(CLI::IsMember(names));
    command->add_option("--bodies", options->bodies, "How many; default: 10000, or 1000 where they meet much")
        ->check(between(1, 10000000));
    command->add_option("--threads", options->threads, "Threads; the hash does not depend on it")
        ->check(between(1, 256))
        ->capture_default_str();
    command->add_option("--seconds", options->seconds, "How long each is measured")
        ->check(between(0.01, 600.0))
        ->capture_default_str();
    command->add_option("--csv", options->csv, "Results as a table")->type_name("FILE.csv");
    command->add_option("--commit", options->commit, "What the table names as the program's version")
        ->capture_default_str();
    command->add_flag("--validate-hash", options->validate_hash, "Fail where the bits are not those they should be");
    command->callback([options] { bench(*options); });
}

} // namespace elastoon
