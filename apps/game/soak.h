// Many games of the bot under the witness's eyes.
#pragma once

#include "play.h"
#include "witness.h"

#include <functional>

namespace squashout {

struct SoakOptions {
    int games = 1000;
    std::uint64_t first_seed = 1;
    double longest = 30.0 * 60.0; ///< s of play within which each must end
    bool oracle = true;
    std::function<void(int)> after_each; ///< told how many games are over; may be empty
};

struct SoakReport {
    Seen seen;
    int games = 0, won = 0, lost = 0, unended = 0;
    std::size_t steps = 0, pops = 0, balls_added = 0, nudges = 0, widenings = 0, blasts = 0, balls_lost = 0;
    int most_score = 0;
    std::uint64_t hash = 0; ///< over all games' hashes, in their order
    std::string unended_seeds;

    [[nodiscard]] bool holds() const { return seen.holds() && unended == 0; }
};

/// Game k has seed first_seed + k; every other one has gravity, skills go from careless to seldom missing, and first
/// levels go round.
[[nodiscard]] SoakReport soak(const std::shared_ptr<const std::vector<Level>>& levels, const SoakOptions& options);

/// One game of the bot, recorded.
[[nodiscard]] Play playOfBot(const std::shared_ptr<const std::vector<Level>>& levels, const GameDef& def, double skill,
                             double longest);

} // namespace squashout
