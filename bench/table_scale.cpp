// Table 7: the same rain at every size, on one thread and on two, by the wall clock; and what a body takes in memory.
#include "tables.h"
#include "worlds.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>

namespace elastoon {

namespace {

double bytesInUse() {
    const struct mallinfo2 info = mallinfo2();
    return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

double wallNanoseconds(WorldContender& world, std::size_t bodies, std::size_t steps) {
    const auto begin = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < steps; ++i) {
        world.step();
    }
    const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - begin;
    return taken.count() / static_cast<double>(bodies) / static_cast<double>(steps);
}

/// Rain begins with all bodies in the air at once, so a step costs four times another: every size goes through the same
/// three seconds, nearly a bounce and a half.
constexpr std::size_t kWarmSteps = 60;
constexpr std::size_t kTurns = 18;
constexpr std::size_t kStepsInTurn = 10;

constexpr std::size_t kSmall = 10000;
constexpr std::size_t kLarge = 1000000;

struct Scale {
    double one = 0.0, two = 0.0; ///< ns a body and step on one thread and on two, over all turns
    double gain = 0.0; ///< median over the turns
    double beside = 0.0; ///< ns a body and step of kSmall bodies, in turns with the one thread's
    double bytes = 0.0; ///< a body, the most after any turn
};

/// Worlds of one thread and of two take turns, and beside the largest one of few bodies; the two must stay equal.
Scale measureScale(std::size_t count, const Effort& effort, const std::string& name, Report& report) {
    const BenchWorld scene = benchWorld("rain", count);
    const std::size_t warm = effort.quick ? 1 : kWarmSteps;
    const std::size_t turns = effort.quick ? 1 : kTurns;
    const std::size_t steps = effort.quick ? 1 : kStepsInTurn;
    const auto small = count == kLarge ? ourWorld(benchWorld("rain", kSmall), 1) : nullptr;
    if (small) {
        wallNanoseconds(*small, kSmall, warm);
    }
    const double before = bytesInUse();
    const auto one = ourWorld(scene, 1);
    wallNanoseconds(*one, count, warm);
    Scale scale;
    const auto two = ourWorld(scene, 2);
    wallNanoseconds(*two, count, warm);
    std::vector<double> ones;
    std::vector<double> twos;
    for (std::size_t turn = 0; turn < turns; ++turn) {
        ones.push_back(wallNanoseconds(*one, count, steps));
        twos.push_back(wallNanoseconds(*two, count, steps));
        if (small) {
            // What the large ones have driven out of the caches comes back, as it does where there are only few.
            (void)small->places();
            scale.beside += wallNanoseconds(*small, kSmall, steps) / static_cast<double>(turns);
        }
        // Both are equal, and what the small one takes is seen in neither.
        scale.bytes = std::max(scale.bytes, (bytesInUse() - before) / static_cast<double>(2 * count));
        scale.one += ones.back() / static_cast<double>(turns);
        scale.two += twos.back() / static_cast<double>(turns);
    }
    scale.gain = medianRatio(ones, twos);
    report.errorAtMost(name + ": two threads differ from one", one->hash() == two->hash() ? 0.0 : 1.0, 0.0);
    return scale;
}

} // namespace

void runScaleTable(const Choice& choice, Report& report) {
    report.begin({"7. Rain at every size (ns a body and step by the wall clock, matrices written)",
                  {{"cell", "", 22},
                   {"1 thread ns", "{:.1f}", 12},
                   {"2 threads ns", "{:.1f}", 13},
                   {"gain", "{:.2f}", 8},
                   {"bytes a body", "{:.0f}", 13},
                   {"2 threads: steps/s", "{:.1f}", 19}},
                  {}});
    for (const std::size_t size : {kSmall, std::size_t{100000}, kLarge}) {
        const std::string name = fmt::format("scale rain {}", size);
        if (!choice.wants(name) || (size == kLarge && !choice.large)) {
            continue;
        }
        const std::size_t count = choice.effort.quick ? 50 : size;
        const Scale scale = measureScale(count, choice.effort, name, report);
        const double rate = 1e9 / (scale.two * static_cast<double>(count));
        report.add({name, scale.one, scale.two, scale.gain, scale.bytes, rate});
        if (size == 100000) {
            report.expectAtLeast(name + ": two threads' gain", scale.gain, 1.7);
        } else if (size == kLarge) {
            report.expectAtLeast(name + ": steps a second on two threads", rate, 10.0);
            report.expectAtMost(name + ": bytes a body", scale.bytes, 512.0);
            if (scale.beside > 0.0) {
                report.expectAtMost(name + ": cost beside 10 000", scale.one / scale.beside, 1.5);
            }
        }
    }
}

} // namespace elastoon
