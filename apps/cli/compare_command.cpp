// elastoon compare: tells where two runs of a scene part.
#include "commands.h"
#include "compare.h"

#include <fmt/format.h>

#include <memory>

namespace elastoon {

namespace {

struct CompareOptions {
    std::string first, second;
};

std::string inWords(const Difference& difference) {
    std::string text = fmt::format("{:.6g} s, {}, body \"{}\"", difference.time, difference.where, difference.body);
    if (difference.field.empty()) {
        return text + fmt::format(": {} in the first, {} in the second", difference.first, difference.second);
    }
    text += fmt::format(": {} is {} and {}", difference.field, difference.first, difference.second);
    return difference.by ? text + fmt::format(", by {:.3g}", *difference.by) : text;
}

void compare(const CompareOptions& options) {
    const RecordedRun first = orFail(readRun(options.first), kExitBadUse);
    const RecordedRun second = orFail(readRun(options.second), kExitBadUse);
    const Comparison comparison = orFail(compareRuns(first, second), kExitBadUse);
    if (!comparison.earliest) {
        fmt::print("equal: {} bodies, {} frames, {} events\n", first.bodies.size(), first.times.size(),
                   first.events.size());
        return;
    }
    fmt::print("first difference: {}\n", inWords(*comparison.earliest));
    if (comparison.furthest > 0.0) {
        fmt::print("furthest apart: {:.3g} m, body \"{}\" at {:.6g} s\n", comparison.furthest, comparison.furthest_body,
                   comparison.furthest_time);
    }
    throw CLI::RuntimeError(kExitFailed);
}

} // namespace

void addCompareCommand(CLI::App& app) {
    auto options = std::make_shared<CompareOptions>();
    CLI::App* command =
        app.add_subcommand("compare", "Tell where two runs of a scene part: time, body, field and how far. "
                                      "Exit codes: 0 equal, 1 they differ, 2 they cannot be compared");
    const char* kinds = "File of elastoon simulate: .json recording, .csv poses or events";
    command->add_option("first", options->first, kinds)->required();
    command->add_option("second", options->second, "Another of the same kind, bodies, rate and duration")->required();
    command->callback([options] { compare(*options); });
}

} // namespace elastoon
