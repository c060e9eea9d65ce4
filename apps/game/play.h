// A recorded play: how a game began and all that its player did, as JSON text. Played again it gives the same game, to
// the bit, on every machine.
#pragma once

#include "game.h"

#include <string>
#include <string_view>

namespace squashout {

struct Play {
    std::uint64_t seed = 1;
    bool gravity = false;
    std::uint32_t first_level = 0;
    std::vector<PlayInput> inputs; ///< one a step
    std::uint64_t hash = 0;        ///< of the game at its end

    [[nodiscard]] std::string toJson() const;
    /// Refused: bad JSON, unknown keys, numbers out of range, more than six hours of play.
    [[nodiscard]] static elastoon::Result<Play> fromJson(std::string_view text, const std::string& file);
};

/// Takes a game of these levels through the play. An error when its hash at the end is not the recorded one.
[[nodiscard]] elastoon::Result<Game> replay(const Play& play, std::shared_ptr<const std::vector<Level>> levels);

/// 16 hexadecimal digits.
[[nodiscard]] std::string hexOf(std::uint64_t value);

} // namespace squashout
