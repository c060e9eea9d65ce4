// The boxes of obstacles and of bodies, over a span of time: what the tree of obstacles is asked with.
#pragma once

#include "elastoon/phase.h"
#include "obstacle_tree.h"

namespace elastoon {

/// Box around the obstacle of this shape at time t: exact but for the rounding of its corners.
[[nodiscard]] Box boxOf(const Shape& shape, const MovingFrame& frame, double t);
/// Box that holds the obstacle at every time within [from, to].
[[nodiscard]] Box sweptBox(const Shape& shape, const MovingFrame& frame, double from, double to);
/// Box that holds a body at every time within [from, to] (not before the phase's start). Of a flight: the parabola's
/// own box, grown by the greatest reach of the body, and by the way that it may be pushed off the surfaces that it
/// leaves.
[[nodiscard]] Box sweptBox(const Phase& flight, const Shape& shape, double from, double to);

} // namespace elastoon
