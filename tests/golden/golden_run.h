// Running the scenes of hashes.txt, in steps as `elastoon simulate` does.
#pragma once

#include "elastoon/scene.h"
#include "elastoon/world.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <functional>
#include <ios>
#include <sstream>
#include <string>
#include <vector>

namespace elastoon {

/// A line of hashes.txt: the scene must end with this hash at this many steps a second.
struct Golden {
    std::string scene; ///< relative to the folder of scenes
    double fps = 60.0;
    std::uint64_t hash = 0;
};

/// The lines that are not comments; an error names the first bad line.
inline Result<std::vector<Golden>> readGoldens(const std::string& file) {
    std::ifstream stream(file);
    if (!stream.is_open()) {
        return Error{"cannot be read", file};
    }
    std::vector<Golden> goldens;
    std::string line;
    for (int number = 1; std::getline(stream, line); ++number) {
        if (line.empty() || line.front() == '#') {
            continue;
        }
        Golden golden;
        std::istringstream words(line);
        if (!(words >> golden.scene >> golden.fps >> std::hex >> golden.hash) || !(golden.fps > 0.0)) {
            return Error{"needs a scene, steps a second and a hash", file + ":" + std::to_string(number)};
        }
        goldens.push_back(golden);
    }
    return goldens;
}

/// The staged scene at its end. `seen` is called before the first step and after each.
inline Result<StagedScene> runGolden(const Golden& golden, const std::string& scenes,
                                     const std::function<void(const Scene&, StagedScene&)>& seen = {},
                                     const ParallelFor& parallel_for = {}) {
    const auto scene = readScene(scenes + "/" + golden.scene);
    if (!scene) {
        return scene.error();
    }
    auto staged = stage(scene.value(), parallel_for);
    if (!staged) {
        return staged.error();
    }
    World& world = staged.value().world;
    const double duration = scene.value().duration;
    if (seen) {
        seen(scene.value(), staged.value());
    }
    for (long step = 1; world.time() < duration; ++step) {
        const double next = std::min(static_cast<double>(step) / golden.fps, duration);
        world.step(std::max(0.0, next - world.time()));
        if (seen) {
            seen(scene.value(), staged.value());
        }
        if (next >= duration) {
            break;
        }
    }
    return staged;
}

} // namespace elastoon
