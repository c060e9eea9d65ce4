// The program: elastoon simulate | render | figures | check | compare | bench. Exit codes: 0 done, 1 failed, 2 bad use.
#include "commands.h"
#include "progress.h"

#include <fmt/format.h>

#include <exception>

int main(int argc, char** argv) {
    CLI::App app{"Elastoon: cartoon squash-and-stretch, live"};
    app.require_subcommand(1);
    app.set_help_all_flag("--help-all", "Print the help of every command and exit");
    elastoon::addSimulateCommand(app);
    elastoon::addRenderCommand(app);
    elastoon::addFiguresCommand(app);
    elastoon::addCheckCommand(app);
    elastoon::addCompareCommand(app);
    elastoon::addBenchCommand(app);
    elastoon::catchInterrupts();
    if (argc > 1 && argv[1][0] != '-' &&
        app.get_subcommands([&](CLI::App* command) { return command->check_name(argv[1]); }).empty()) {
        fmt::print(
            stderr,
            "elastoon: there is no command \"{}\"; there are simulate, render, figures, check, compare and bench\n",
            argv[1]);
        return elastoon::kExitBadUse;
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::RuntimeError& end) {
        return end.get_exit_code();
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : elastoon::kExitBadUse;
    } catch (const std::exception& error) {
        fmt::print(stderr, "elastoon: {}\n", error.what());
        return elastoon::kExitFailed;
    }
    return 0;
}
