// See soak.h.
#include "soak.h"

#include "bot.h"

#include "hash.h"

#include <algorithm>

namespace squashout {

namespace {

GameDef defOf(const std::shared_ptr<const std::vector<Level>>& levels, std::uint64_t seed) {
    GameDef def;
    def.levels = levels;
    def.seed = seed;
    def.gravity = seed % 2 == 0;
    def.first_level = static_cast<std::uint32_t>((seed / 2) % levels->size());
    return def;
}

double skillOf(std::uint64_t seed) {
    constexpr std::uint64_t kSkills = 6;
    return 0.3 + 0.1 * static_cast<double>(seed % kSkills);
}

void count(const Game& game, SoakReport& report) {
    for (const GameEvent& event : game.events()) {
        report.pops += event.kind == GameEventKind::Popped ? 1 : 0;
        report.balls_added += event.kind == GameEventKind::BallAdded ? 1 : 0;
        report.nudges += event.kind == GameEventKind::Nudged ? 1 : 0;
        report.widenings += event.kind == GameEventKind::Widened ? 1 : 0;
        report.blasts += event.kind == GameEventKind::Exploded ? 1 : 0;
        report.balls_lost += event.kind == GameEventKind::BallLost ? 1 : 0;
    }
}

} // namespace

SoakReport soak(const std::shared_ptr<const std::vector<Level>>& levels, const SoakOptions& options) {
    SoakReport report;
    elastoon::Hash hash;
    const auto most = static_cast<std::uint64_t>(options.longest / kStep);
    for (int i = 0; i < options.games; ++i) {
        const std::uint64_t seed = options.first_seed + static_cast<std::uint64_t>(i);
        Game game(defOf(levels, seed));
        Bot bot(seed, skillOf(seed));
        Witness witness;
        while (!game.over() && game.steps() < most) {
            game.step(bot.play(game));
            count(game, report);
            if (options.oracle) {
                witness.look(game);
            }
        }
        report.seen.add(witness.seen());
        report.seen.escapes += options.oracle ? 0 : static_cast<std::size_t>(game.escapes());
        report.steps += game.steps();
        report.won += game.stage() == Stage::Won ? 1 : 0;
        report.lost += game.stage() == Stage::Lost ? 1 : 0;
        if (!game.over()) {
            ++report.unended;
            report.unended_seeds += std::to_string(seed) + " ";
        }
        report.most_score = std::max(report.most_score, game.score());
        hash.add(game.hash());
        ++report.games;
        if (options.after_each) {
            options.after_each(report.games);
        }
    }
    report.hash = hash.value();
    return report;
}

Play playOfBot(const std::shared_ptr<const std::vector<Level>>& levels, const GameDef& def, double skill,
               double longest) {
    GameDef whole = def;
    whole.levels = levels;
    Game game(whole);
    Bot bot(def.seed, skill);
    Play play{def.seed, def.gravity, def.first_level, {}, 0};
    while (!game.over() && static_cast<double>(game.steps()) * kStep < longest) {
        play.inputs.push_back(bot.play(game));
        game.step(play.inputs.back());
    }
    play.hash = game.hash();
    return play;
}

} // namespace squashout
