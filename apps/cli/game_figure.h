// Figure 8: a recorded play of Squashout as a scene and a timeline, to be drawn like any other.
#pragma once

#include "elastoon/scene.h"
#include "elastoon/timeline.h"

#include <string>

namespace elastoon {

/// A play from the launch of the ball to its end.
struct PlayedSequence {
    Scene scene;       ///< of the picture: what popped is pale, the paddle is where it touched the ball
    Scene film;        ///< of the video: what pops is carried off, the paddle moves
    Timeline timeline; ///< of the ball
};

/// Plays `folder`/play.json on `folder`/levels.json. Refused: what is no such play, and one with another hash than
/// the recorded one or without a ball.
[[nodiscard]] Result<PlayedSequence> playSequence(const std::string& folder);

} // namespace elastoon
