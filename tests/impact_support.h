// Random impacts for tests: on the ground, and on the edges of a box beside a plane.
#pragma once

#include "elastoon/phase.h"
#include "test_support.h"

#include <optional>

namespace elastoon {

/// An impact on the ground, and when it ends.
struct Struck {
    Phase phase;
    ShapePtr shape;
};

/// One half of the curve may take hardly any time: then it is fast. None where nothing is struck.
[[nodiscard]] std::optional<Struck> randomImpact(Random& random, int i);

/// A random impact on the ground beside a plane that it is kept clear of, which leans any way: some find no room.
[[nodiscard]] std::optional<Struck> randomImpactByWall(Random& random, int i);

/// An impact on a box, most often on an edge or a corner of it, every other one beside a plane that it is kept clear
/// of.
[[nodiscard]] std::optional<Struck> randomSteepImpact(Random& random, int i);

} // namespace elastoon
