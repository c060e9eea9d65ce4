// elastoon_bench: the library beside its peers on the same cases in the same run. Exit codes: 0 done, 1 a bound is
// missed or the file cannot be written, 2 bad use.
#include "output_file.h"
#include "tables.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <exception>
#include <fstream>
#include <optional>

namespace elastoon {
namespace {

bool save(OutputFile& file, const Report& report) {
    std::ofstream stream(file.temporaryPath());
    stream << report.asJson().dump(1) << '\n';
    stream.close();
    const Status committed = stream ? file.commit() : Error{"cannot write: is the disk full?", file.temporaryPath()};
    if (!committed) {
        fmt::print(stderr, "elastoon_bench: {}\n", committed.error().text());
    }
    return committed.ok();
}

int runBench(int argc, char** argv) {
    CLI::App app{"Elastoon beside FCL, Bullet, libccd and Qhull on the same cases: docs/bench.md"};
    Choice choice;
    bool check = false;
    std::string output;
    app.add_flag("--quick", choice.effort.quick, "Few cases, no timing worth the name: that all run and are right");
    app.add_flag("--large", choice.large, "The world of a million bodies, too: two gigabytes, a minute");
    app.add_flag("--check", check, "Hold the speeds to their bounds too; the errors always are");
    app.add_option("--filter", choice.filter, "Only cells whose name holds this, as \"coherent floor\"");
    app.add_option("--seconds", choice.effort.seconds, "CPU time of each cell")->capture_default_str();
    app.add_option("-o", output, "Results as JSON")->type_name("FILE.json");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    if (check && choice.effort.quick) {
        fmt::print(stderr, "elastoon_bench: --quick takes no times that --check could judge\n");
        return 2;
    }
    if (!(choice.effort.seconds >= 0.01 && choice.effort.seconds <= 600.0)) {
        fmt::print(stderr, "elastoon_bench: --seconds must be from 0.01 to 600\n");
        return 2;
    }
    // A place that cannot be written should be known before the long run.
    std::optional<OutputFile> file;
    if (!output.empty()) {
        auto made = OutputFile::create(output);
        if (!made) {
            fmt::print(stderr, "elastoon_bench: {}\n", made.error().text());
            return 1;
        }
        file.emplace(std::move(made).value());
    }
    Report report;
    runDistanceTables(choice, report);
    runTouchTable(choice, report);
    runSupportTable(choice, report);
    runHullTable(choice, report);
    runWorldTable(choice, report);
    runScaleTable(choice, report);
    runRollbackTable(choice, report);
    if (report.empty()) {
        fmt::print(stderr, "elastoon_bench: no cell's name holds \"{}\"\n", choice.filter);
        return 2;
    }
    const bool holds = report.judge(choice.effort.quick ? Speeds::Hidden : check ? Speeds::Judged : Speeds::Shown);
    if (file && !save(*file, report)) {
        return 1;
    }
    return holds ? 0 : 1;
}

} // namespace
} // namespace elastoon

int main(int argc, char** argv) {
    try {
        return elastoon::runBench(argc, argv);
    } catch (const std::exception& error) {
        fmt::print(stderr, "elastoon_bench: {}\n", error.what());
        return 1;
    }
}
