// Levels: rows of letters in JSON, checked in full. docs/game.md has the format.
#pragma once

#include "elastoon/result.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace squashout {

enum class BlockKind : std::uint8_t {
    Plain,
    Tough,     ///< several hits
    Jelly,     ///< two hits, and it throws back
    Moving,    ///< goes to and fro
    Explosive, ///< takes its neighbours along
    Ball,      ///< lets a second ball out
    Wide,      ///< widens the paddle
    Heart,     ///< a life
    Stone,     ///< stays
};

/// What a kind is, for reader, rules and help alike.
struct KindTraits {
    BlockKind kind;
    char letter; ///< in a level's rows
    std::string_view name;
    int hits; ///< 0: it stays
    int points;
    bool is_round;
    std::string_view style; ///< of the library's named styles: how it answers a hit
};

[[nodiscard]] const std::array<KindTraits, 9>& kinds();
[[nodiscard]] const KindTraits& traitsOf(BlockKind kind);

struct LevelBlock {
    BlockKind kind = BlockKind::Plain;
    int row = 0, column = 0;
    double x = 0.0, y = 0.0;   ///< of the middle, m
    double by = 0.0;           ///< it goes this far to the right and back, m; 0: it stands
    double period = 0.0;       ///< s there and back
};

struct Level {
    std::string name;
    double speed = 9.0;   ///< of the ball, m/s
    double gravity = 2.0; ///< m/s^2, when played with gravity
    std::vector<LevelBlock> blocks;
};

/// The text of a level file. Every key, letter and range is checked, and that no moving block runs into another or a
/// wall; an error says where.
[[nodiscard]] elastoon::Result<std::vector<Level>> parseLevels(std::string_view text, const std::string& file);
[[nodiscard]] elastoon::Result<std::vector<Level>> readLevels(const std::string& file);

} // namespace squashout
