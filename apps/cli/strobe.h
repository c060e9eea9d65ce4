// Many moments in one picture: early ones pale, later ones stronger, the last one full.
#pragma once

#include "tracer.h"

#include "elastoon/scene.h"

#include <functional>
#include <span>
#include <vector>

namespace elastoon {

/// The things of one moment, and how strongly they are drawn: 1 is full.
struct Ghost {
    std::vector<Thing> things;
    float weight = 1.0F;
};

/// Times from..to, `every` s apart, both ends where they fall on it. `end` stands for a negative `to`.
[[nodiscard]] std::vector<double> strobeTimes(const SceneStrobe& strobe, double end);

/// Strength of ghost `index` of `count`: grows with the index, 1 for the last.
[[nodiscard]] float ghostWeight(std::size_t index, std::size_t count);

/// Draws the ghosts over the tracer's background, in order: a later one hides an earlier one, no shadow falls twice.
/// `step` is called after each; false stops, and the picture is then unfinished.
[[nodiscard]] Picture strobePicture(const Tracer& tracer, std::span<const Ghost> ghosts,
                                    const std::function<bool(std::size_t)>& step = {});

} // namespace elastoon
