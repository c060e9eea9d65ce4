// The program's commands. Each adds itself to the command line; its callback throws CLI::RuntimeError(code) to end.
#pragma once

#include "elastoon/result.h"
#include "elastoon/scene.h"
#include "elastoon/timeline.h"

#include <CLI/CLI.hpp>

#include <string>

namespace elastoon {

void addSimulateCommand(CLI::App& app);
void addRenderCommand(CLI::App& app);
void addFiguresCommand(CLI::App& app);
void addCheckCommand(CLI::App& app);
void addCompareCommand(CLI::App& app);
void addBenchCommand(CLI::App& app);

/// Accepts numbers from least to most; unlike CLI::Range, it refuses NaN.
[[nodiscard]] CLI::Validator between(double least, double most);

/// Exit codes of the program.
inline constexpr int kExitFailed = 1;
inline constexpr int kExitBadUse = 2;

/// Prints "elastoon: <text>" on standard error and ends the command with the code.
[[noreturn]] void fail(const Error& error, int code = kExitFailed);

/// The value, or fail().
template <class T>
T orFail(Result<T> result, int code = kExitFailed) {
    if (!result) {
        fail(result.error(), code);
    }
    return std::move(result).value();
}

/// Reads a scene with mesh support; ends the command with code 2 on bad input. Where `style` is not empty, every body
/// gets the library's style of that name.
[[nodiscard]] Scene loadScene(const std::string& file, const std::string& style = {});

/// Adds the option --style, for loadScene().
void addStyleOption(CLI::App& command, std::string& style);

/// What a scene did from 0 to `duration`, in phases.
struct Performance {
    StagedScene staged; ///< after the last step
    Timeline timeline;
};

/// Runs the scene in steps of 1/60 s and keeps its timeline.
[[nodiscard]] Performance perform(const Scene& scene, double duration);

} // namespace elastoon
