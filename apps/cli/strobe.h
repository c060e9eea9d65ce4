// Many moments in one picture: early ones pale, later ones stronger, the last one full.
#pragma once

#include "tracer.h"

#include "elastoon/scene.h"

#include <functional>
#include <span>
#include <vector>

namespace elastoon {

/// The things of one moment, and how strongly they are drawn.
struct Ghost {
    std::vector<Thing> things;
    float weight = 1.0F; ///< 1 is full
    bool trail = false;  ///< part of a faint veil behind all others; throws no shadow, the weight is not read
};

/// Times from..to, `every` s apart, both ends where they fall on it. `end` stands for a negative `to`.
[[nodiscard]] std::vector<double> strobeTimes(const SceneStrobe& strobe, double end);

/// Which of a body's ghosts are drawn strongly: the first, the last, the deepest squashes, the tops of hops, and as
/// many others as find room beside them. The rest would only cover these. Poses are as drawn, in order of time.
[[nodiscard]] std::vector<bool> keyGhosts(const Shape& shape, std::span<const Pose> poses, const Vec3& up);

/// Strength of ghost `index` of `count`: grows with the index, 1 for the last.
[[nodiscard]] float ghostWeight(std::size_t index, std::size_t count);

/// Draws the ghosts over the tracer's background, in order of time: a later one hides an earlier one, no shadow falls
/// twice. `step` is called after each; false stops, and the picture is then unfinished.
[[nodiscard]] Picture strobePicture(const Tracer& tracer, std::span<const Ghost> ghosts,
                                    const std::function<bool(std::size_t)>& step = {});

} // namespace elastoon
