// What the commands share: reading a scene, running it, ending with a message, checking numbers.
#include "commands.h"
#include "mesh_file.h"
#include "progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>
#include <vector>

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

void addStyleOption(CLI::App& command, std::string& style) {
    const std::string names = fmt::format("{}", fmt::join(styleNames(), ", "));
    command.add_option("--style", style, "Gives every body this style: " + names)->option_text("NAME");
}

Scene loadScene(const std::string& file, const std::string& style) {
    std::vector<TriangleMesh> meshes;
    const auto readPoints = [&](const std::string& path) -> Result<std::vector<Vec3>> {
        auto mesh = readMesh(path);
        if (!mesh) {
            return mesh.error();
        }
        meshes.push_back(std::move(mesh).value());
        return meshes.back().points;
    };
    Scene scene = orFail(readScene(file, readPoints), kExitBadUse);
    // The meshes were read in the order of the shapes.
    std::size_t next = 0;
    for (const SceneShape& shape : scene.shapes) {
        if (!shape.mesh_file.empty()) {
            const std::string note = hullNote(shape.name, shape.mesh_file, meshes[next], shape.shape->volume());
            fmt::print(stderr, "{}{}", note, note.empty() ? "" : "\n");
            ++next;
        }
    }
    if (!style.empty()) {
        const std::optional<Style> named = styleNamed(style);
        if (!named) {
            fail({fmt::format("there is no style \"{}\"; known: {}", style, fmt::join(styleNames(), ", ")), "--style"},
                 kExitBadUse);
        }
        for (SceneBody& body : scene.bodies) {
            body.def.style = *named;
        }
    }
    return scene;
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
