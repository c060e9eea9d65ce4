// elastoon-game: Squashout without a screen. Checks levels, plays them by the bot, and plays recorded games again.
#include "commands.h"
#include "progress.h"
#include "soak.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace {

using squashout::Level;
using LevelsPtr = std::shared_ptr<const std::vector<Level>>;

struct Options {
    std::string levels = "apps/game/levels.json";
    std::string file;
    int games = 20;
    std::uint64_t seed = 1;
    bool gravity = false, no_oracle = false;
    std::uint32_t level = 1;
    double skill = 0.95, seconds = 600.0;
};

LevelsPtr levelsOf(const Options& options) {
    return std::make_shared<const std::vector<Level>>(
        elastoon::orFail(squashout::readLevels(options.levels), elastoon::kExitBadUse));
}

void runSoak(const Options& options) {
    elastoon::Progress progress("games", options.games);
    squashout::SoakOptions wanted;
    wanted.games = options.games;
    wanted.first_seed = options.seed;
    wanted.oracle = !options.no_oracle;
    wanted.after_each = [&](int played) { progress.at(played); };
    const auto report = squashout::soak(levelsOf(options), wanted);
    fmt::print(
        "games={} won={} lost={} unended={} minutes={:.0f} pops={} blasts={} balls_added={} balls_lost={} nudges={} "
        "widenings={} most_score={}\n",
        report.games, report.won, report.lost, report.unended,
        static_cast<double>(report.steps) * squashout::kStep / 60.0, report.pops, report.blasts, report.balls_added,
        report.balls_lost, report.nudges, report.widenings, report.most_score);
    if (wanted.oracle) {
        fmt::print(
            "looks={} wall_depth={:.2e} solid_depth={:.2e} not_finite={} escapes={} squeezes={} speed={:.2f}..{:.2f} "
            "longest_contact={:.3f}\n",
            report.seen.looks, report.seen.depth, report.seen.solid_depth, report.seen.not_finite, report.seen.escapes,
            report.seen.squeezes, report.seen.slowest, report.seen.fastest, report.seen.longest_contact);
    }
    if (!report.seen.deepest_where.empty()) {
        fmt::print("deepest: {}\n", report.seen.deepest_where);
    }
    if (report.unended > 0) {
        fmt::print("not ended: {}\n", report.unended_seeds);
    }
    fmt::print("hash={}\n", squashout::hexOf(report.hash));
    if (!report.holds()) {
        elastoon::fail({"a bound is broken", "bot"});
    }
}

void runRecord(const Options& options) {
    squashout::GameDef def;
    def.seed = options.seed;
    def.gravity = options.gravity;
    def.first_level = options.level - 1;
    const auto play = squashout::playOfBot(levelsOf(options), def, options.skill, options.seconds);
    const auto folder = std::filesystem::path(options.file).parent_path();
    std::error_code ignored; // what cannot be made cannot be written to, which is told
    std::filesystem::create_directories(folder, ignored);
    std::ofstream stream(options.file, std::ios::binary);
    stream << play.toJson();
    if (!stream.flush()) {
        elastoon::fail({"cannot be written", options.file});
    }
    fmt::print("steps={} hash={}\n", play.inputs.size(), squashout::hexOf(play.hash));
}

void runReplay(const Options& options) {
    std::ifstream stream(options.file, std::ios::binary);
    std::stringstream text;
    text << stream.rdbuf();
    if (!stream) {
        elastoon::fail({"cannot be read", options.file}, elastoon::kExitBadUse);
    }
    const auto play = elastoon::orFail(squashout::Play::fromJson(text.str(), options.file), elastoon::kExitBadUse);
    const auto game = elastoon::orFail(squashout::replay(play, levelsOf(options)));
    fmt::print("steps={} level={} score={} lives={} hash={}\n", game.steps(), game.levelIndex() + 1, game.score(),
               game.lives(), squashout::hexOf(game.hash()));
}

void runCheck(const Options& options) {
    const LevelsPtr levels = levelsOf(options);
    for (const Level& level : *levels) {
        fmt::print("{}: {} blocks, {} m/s\n", level.name, level.blocks.size(), level.speed);
    }
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app("Squashout without a screen", "elastoon-game");
    app.require_subcommand(1);
    Options options;
    const auto withLevels = [&](CLI::App* command) {
        command->add_option("--levels", options.levels, "Level file")->capture_default_str();
        return command;
    };
    CLI::App* bot = withLevels(app.add_subcommand("bot", "Play games by the bot while an independent oracle watches"));
    bot->add_option("--games", options.games, "How many")->check(elastoon::between(1, 1e6))->capture_default_str();
    bot->add_option("--seed", options.seed, "Of the first game; each next one has one more")->capture_default_str();
    bot->add_flag("--no-oracle", options.no_oracle, "Only play");
    bot->callback([&] { runSoak(options); });

    CLI::App* record = withLevels(app.add_subcommand("record", "Record a game of the bot"));
    record->add_option("-o,--output", options.file, "File to write")->required();
    record->add_option("--seed", options.seed, "Of the game")->capture_default_str();
    record->add_option("--level", options.level, "First level, from 1")->check(elastoon::between(1, 1000));
    record->add_option("--skill", options.skill, "Of the bot")->check(elastoon::between(0, 1))->capture_default_str();
    record->add_option("--seconds", options.seconds, "At most")
        ->check(elastoon::between(0, 20000))
        ->capture_default_str();
    record->add_flag("--gravity", options.gravity, "With gravity");
    record->callback([&] { runRecord(options); });

    CLI::App* replay = withLevels(app.add_subcommand("replay", "Play a recorded game again; its hash must come out"));
    replay->add_option("FILE", options.file, "The recorded game")->required();
    replay->callback([&] { runReplay(options); });

    CLI::App* check = withLevels(app.add_subcommand("check", "Check a level file"));
    check->callback([&] { runCheck(options); });
    try {
        app.parse(argc, argv);
    } catch (const CLI::RuntimeError& end) {
        return end.get_exit_code();
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : elastoon::kExitBadUse;
    }
    return 0;
}
