// What the commands share: reading a scene, running it, ending with a message, checking numbers.
#include "commands.h"
#include "mesh_file.h"
#include "progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace elastoon {

void fail(const Error& error, int code) {
    fmt::print(stderr, "elastoon: {}\n", error.text());
    throw CLI::RuntimeError(code);
}

CLI::Validator between(double least, double most) {
    const std::string range = fmt::format("{:g} to {:g}", least, most);
    return CLI::Validator(
        [=](std::string& text) -> std::string {
            double value = 0.0;
            const bool number = CLI::detail::lexical_cast(text, value);
            return number && value >= least && value <= most
                       ? std::string{}
                       : fmt::format("must be a number from {}, is {}", range, text);
        },
        range);
}

Scene loadScene(const std::string& file) {
    return orFail(readScene(file, readMeshPoints), kExitBadUse);
}

Performance perform(const Scene& scene, double duration) {
    constexpr double kStep = 1.0 / 60.0;
    Performance performance{orFail(stage(scene), kExitBadUse), {}};
    World& world = performance.staged.world;
    performance.timeline.begin(world);
    const auto steps = static_cast<long>(std::ceil(duration / kStep - 1e-9));
    for (long i = 0; i < steps; ++i) {
        world.step(std::min(kStep, duration - world.time()));
        performance.timeline.capture(world);
        if (interrupted()) {
            fail({"interrupted; nothing was written", ""});
        }
    }
    return performance;
}

} // namespace elastoon
