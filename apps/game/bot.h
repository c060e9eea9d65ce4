// A player made of rules: for the attract mode, for tests and for soaks. It sees what a player sees, and gives the same
// inputs.
#pragma once

#include "game.h"

namespace squashout {

class Bot {
public:
    /// `skill` 0..1: how well it judges where a ball comes down. 1 seldom misses.
    explicit Bot(std::uint64_t seed, double skill = 1.0) : random_(seed), skill_(skill) {}

    [[nodiscard]] PlayInput play(const Game& game);

private:
    struct Landing {
        double time = 0.0, x = 0.0;
        std::uint32_t ball = 0;
        bool falls = false;
    };
    [[nodiscard]] static std::optional<Landing> nextLanding(const Game& game);
    void aim(const Game& game, const Landing& landing);

    Random random_;
    double skill_;
    double hand_ = 0.0; ///< where it holds the paddle, m
    double offset_ = 0.0; ///< of the landing from the paddle's middle that it wants, share of the half width
    double error_ = 0.0; ///< m
    std::uint32_t aimed_ball_ = 0;
    bool aimed_falling_ = false;
    double waits_ = 0.5; ///< s, before it launches
};

} // namespace squashout
