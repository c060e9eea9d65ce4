// See level.h.
#include "level.h"

#include "scene_json.h"
#include "tuning.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace squashout {

using elastoon::Json;
using elastoon::JsonReader;
using elastoon::pathPart;
using elastoon::Result;

const std::array<KindTraits, 9>& kinds() {
    static constexpr std::array<KindTraits, 9> kKinds{{
        {BlockKind::Plain, 'p', "plain", 1, 10, false, "rubber-ball"},
        {BlockKind::Tough, 't', "tough", 2, 20, false, "tin-can"},
        {BlockKind::Jelly, 'j', "jelly", 2, 25, false, "jelly"},
        {BlockKind::Moving, 'm', "moving", 1, 20, false, "rubber-ball"},
        {BlockKind::Explosive, 'x', "explosive", 1, 15, true, "beach-ball"},
        {BlockKind::Ball, 'o', "ball", 1, 15, true, "water-balloon"},
        {BlockKind::Wide, 'w', "wide", 1, 15, false, "mochi"},
        {BlockKind::Heart, 'h', "heart", 1, 50, false, "pillow"},
        {BlockKind::Stone, 's', "stone", 0, 0, false, "anvil"},
    }};
    return kKinds;
}

const KindTraits& traitsOf(BlockKind kind) {
    return kinds()[static_cast<std::size_t>(kind)];
}

namespace {

struct Motion {
    double by = 0.0, period = 0.0;
};

/// "p plain, t tough, ..."
std::string listOfLetters() {
    std::string list = ". nothing";
    for (const KindTraits& traits : kinds()) {
        list += std::string(", ") + traits.letter + " " + std::string(traits.name);
    }
    return list;
}

void addRow(JsonReader& reader, const std::string& row, int index, const std::string& path, const Motion& motion,
            Level& level) {
    if (row.size() > kColumns) {
        reader.fail(path, "has " + std::to_string(row.size()) + " places, there are " + std::to_string(kColumns));
        return;
    }
    for (std::size_t column = 0; column < row.size(); ++column) {
        const auto found = std::find_if(kinds().begin(), kinds().end(),
                                        [&](const KindTraits& traits) { return traits.letter == row[column]; });
        if (row[column] == '.' || row[column] == ' ') {
            continue;
        }
        if (found == kinds().end()) {
            reader.fail(path, std::string("'") + row[column] + "' at place " + std::to_string(column + 1) +
                                  " is no kind of block; known: " + listOfLetters());
            return;
        }
        LevelBlock block;
        block.kind = found->kind;
        block.row = index;
        block.column = static_cast<int>(column);
        block.x = (static_cast<double>(column) - 0.5 * (kColumns - 1)) * kColumnPitch;
        block.y = kTopRow - index * kRowPitch;
        if (block.kind == BlockKind::Moving) {
            block.by = motion.by;
            block.period = motion.period;
        }
        level.blocks.push_back(block);
    }
}

double halfWidthOf(const LevelBlock& block) {
    return traitsOf(block.kind).is_round ? kRoundBlock : 0.5 * kBlockWidth;
}

std::string placeOf(const LevelBlock& block) {
    return "row " + std::to_string(block.row + 1) + ", place " + std::to_string(block.column + 1);
}

/// A moving block must not close on a ball: along its whole way there is a ball's room to the walls and to all that
/// does not move with it.
void checkWays(JsonReader& reader, const Level& level, const std::string& path) {
    constexpr double kRoom = 2.0 * kBallRadius + 0.08;
    for (const LevelBlock& block : level.blocks) {
        if (block.by == 0.0) {
            continue;
        }
        const double left = block.x + std::min(0.0, block.by) - halfWidthOf(block) - kRoom;
        const double right = block.x + std::max(0.0, block.by) + halfWidthOf(block) + kRoom;
        if (left < -kHalfWidth || right > kHalfWidth) {
            reader.fail(path, "the moving block at " + placeOf(block) +
                                  " would leave no room for a ball at a wall; moving.by says how many places it goes");
            return;
        }
        for (const LevelBlock& other : level.blocks) {
            const bool together = other.by == block.by && other.period == block.period;
            const double between = std::fabs(other.y - block.y) - kBlockHeight;
            if (!together && between < kRoom && other.x - halfWidthOf(other) < right &&
                other.x + halfWidthOf(other) > left) {
                reader.fail(path, "the moving block at " + placeOf(block) +
                                      " would leave no room for a ball to the one at " + placeOf(other) +
                                      "; keep a row free, or let moving.by be less");
                return;
            }
        }
    }
}

Motion readMotion(JsonReader& reader, const Json& json, const std::string& path) {
    constexpr double kMostPlaces = kColumns;
    constexpr double kShortest = 1.0, kLongest = 60.0;
    Motion motion{kColumnPitch, 4.0};
    const Json* moving = JsonReader::member(json, "moving");
    if (moving == nullptr || !reader.object(*moving, path + "/moving", {"by", "period"})) {
        return motion;
    }
    if (const Json* by = JsonReader::member(*moving, "by")) {
        motion.by = kColumnPitch * reader.number(*by, path + "/moving/by", -kMostPlaces, kMostPlaces, "places");
    }
    if (const Json* period = JsonReader::member(*moving, "period")) {
        motion.period = reader.number(*period, path + "/moving/period", kShortest, kLongest, "s");
    }
    return motion;
}

Level readLevel(JsonReader& reader, const Json& json, const std::string& path) {
    constexpr double kSlowest = 5.0, kFastest = 20.0, kMostGravity = 4.0;
    constexpr std::size_t kLongestName = 40;
    Level level;
    if (!reader.object(json, path, {"name", "speed", "gravity", "moving", "rows"})) {
        return level;
    }
    if (const Json* name = reader.required(json, path, "name")) {
        level.name = reader.text(*name, path + "/name");
        if (level.name.empty() || level.name.size() > kLongestName) {
            reader.fail(path + "/name", "must have 1 to " + std::to_string(kLongestName) + " letters");
        }
    }
    if (const Json* speed = JsonReader::member(json, "speed")) {
        level.speed = reader.number(*speed, path + "/speed", kSlowest, kFastest, "m/s");
    }
    if (const Json* gravity = JsonReader::member(json, "gravity")) {
        level.gravity = reader.number(*gravity, path + "/gravity", 0.0, kMostGravity, "m/s^2");
    }
    const Motion motion = readMotion(reader, json, path);
    const Json* rows = reader.required(json, path, "rows");
    if (rows == nullptr || !reader.array(*rows, path + "/rows")) {
        return level;
    }
    if (rows->size() > kMostRows) {
        reader.fail(path + "/rows", "there is room for " + std::to_string(kMostRows) + " rows");
    }
    int index = 0;
    for (const Json& row : *rows) {
        const std::string place = path + "/rows" + pathPart(static_cast<std::size_t>(index));
        addRow(reader, reader.text(row, place), index, place, motion, level);
        ++index;
        if (reader.failed()) {
            return level;
        }
    }
    const auto breaks = [](const LevelBlock& block) { return traitsOf(block.kind).hits > 0; };
    if (std::none_of(level.blocks.begin(), level.blocks.end(), breaks)) {
        reader.fail(path + "/rows", "must hold a block that breaks, or the level has no end");
    }
    checkWays(reader, level, path + "/rows");
    return level;
}

} // namespace

Result<std::vector<Level>> parseLevels(std::string_view text, const std::string& file) {
    auto parsed = elastoon::parseJson(text, file);
    if (!parsed) {
        return parsed.error();
    }
    const Json& json = parsed.value();
    JsonReader reader(file);
    std::vector<Level> levels;
    if (reader.object(json, "", {"squashout", "levels"})) {
        if (const Json* version = reader.required(json, "", "squashout")) {
            (void)reader.number(*version, "/squashout", 1, 1);
        }
        const Json* list = reader.required(json, "", "levels");
        if (list != nullptr && reader.array(*list, "/levels")) {
            for (const Json& level : *list) {
                levels.push_back(readLevel(reader, level, "/levels" + pathPart(levels.size())));
                if (reader.failed()) {
                    break;
                }
            }
            if (levels.empty()) {
                reader.fail("/levels", "must hold a level");
            }
        }
    }
    if (reader.failed()) {
        return *reader.error();
    }
    return levels;
}

} // namespace squashout
