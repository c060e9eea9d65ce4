// What a view draws: every thing of a game with its place and form, between two steps. No drawing here.
#pragma once

#include "game.h"

namespace squashout {

enum class DrawnKind : std::uint8_t { Block, Paddle, Ball, WaitingBall };

struct Drawn {
    DrawnKind what = DrawnKind::Block;
    BlockKind block = BlockKind::Plain;
    std::uint32_t id = 0;
    double extra = 0.0; ///< of a block: hits left; of the paddle: half its width; of a ball: 1 in an impact
    Vec3 position{0.0};
    elastoon::Mat3 linear{1.0}; ///< on the thing's own size
};

/// Keeps what was drawn one step ago, so that a view of any rate can draw in between.
class View {
public:
    /// To be called after each step.
    void capture(const Game& game);
    /// `share` 0: as one step ago; 1: as now. What is new is as now.
    [[nodiscard]] std::vector<Drawn> drawn(double share) const;

private:
    std::vector<Drawn> before_, now_;
};

} // namespace squashout
