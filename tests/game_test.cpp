// Squashout's rules: what each block does, that a paddle aims, that games go the same way each time, and that nothing
// is entered while a bot plays. The thousand games of a soak are the program's: elastoon-game bot --games 1000.
#include "bot.h"
#include "play.h"
#include "soak.h"
#include "view.h"

#include "test_support.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

namespace squashout {
namespace {

using elastoon::valueOf;
using LevelsPtr = std::shared_ptr<const std::vector<Level>>;

const std::string kSource = ELASTOON_SOURCE_DIR;

LevelsPtr realLevels() {
    return std::make_shared<const std::vector<Level>>(valueOf(readLevels(kSource + "/apps/game/levels.json")));
}

/// One level of these rows.
LevelsPtr levelOf(const std::string& rows, const std::string& more = "") {
    const std::string text =
        R"({"squashout":1,"levels":[{"name":"test","speed":9,"gravity":2)" + more + R"(,"rows":[)" + rows + "]}]}";
    return std::make_shared<const std::vector<Level>>(valueOf(parseLevels(text, "test")));
}

GameDef defOf(LevelsPtr levels, std::uint64_t seed = 1, bool gravity = false) {
    GameDef def;
    def.levels = std::move(levels);
    def.seed = seed;
    def.gravity = gravity;
    return def;
}

/// Plays by the bot until something of this kind happens; the events of all steps until then.
std::vector<GameEvent> playUntil(Game& game, GameEventKind kind, double seconds = 120.0) {
    Bot bot(7, 1.0);
    std::vector<GameEvent> all;
    const auto most = game.steps() + static_cast<std::uint64_t>(seconds / kStep);
    while (!game.over() && game.steps() < most) {
        game.step(bot.play(game));
        all.insert(all.end(), game.events().begin(), game.events().end());
        const bool found = std::any_of(game.events().begin(), game.events().end(),
                                       [&](const GameEvent& event) { return event.kind == kind; });
        if (found) {
            return all;
        }
    }
    ADD_FAILURE() << "did not happen";
    return all;
}

std::size_t countOf(const std::vector<GameEvent>& events, GameEventKind kind) {
    return static_cast<std::size_t>(
        std::count_if(events.begin(), events.end(), [&](const GameEvent& event) { return event.kind == kind; }));
}

TEST(GameLevels, TheRealOnesAreSoundAndGrow) {
    const LevelsPtr levels = realLevels();
    ASSERT_EQ(levels->size(), 8U);
    std::set<BlockKind> used;
    for (std::size_t i = 0; i < levels->size(); ++i) {
        for (const LevelBlock& block : (*levels)[i].blocks) {
            used.insert(block.kind);
        }
        EXPECT_TRUE(i == 0 || (*levels)[i].speed > (*levels)[i - 1].speed) << i;
    }
    EXPECT_EQ(used.size(), kinds().size());
}

TEST(GameLevels, MistakesAreToldWithTheirPlace) {
    const auto messageOf = [](const std::string& text) {
        const auto levels = parseLevels(text, "f.json");
        return levels ? std::string("taken") : levels.error().text();
    };
    const auto with = [&](const std::string& level) {
        return messageOf(R"({"squashout":1,"levels":[{"name":"a",)" + level + "}]}");
    };
    EXPECT_EQ(with(R"("rows":["p?"])").find("f.json: /levels/0/rows/0: '?' at place 2 is no kind of block"), 0U);
    EXPECT_EQ(with(R"("rows":["ppppppppppp"])"), "f.json: /levels/0/rows/0: has 11 places, there are 10");
    EXPECT_EQ(with(R"("rows":["ss"])"),
              "f.json: /levels/0/rows: must hold a block that breaks, or the level has no end");
    EXPECT_NE(with(R"("rows":["m"])").find("row 1, place 1 would leave no room for a ball at a wall"),
              std::string::npos);
    EXPECT_NE(with(R"("rows":[".m","..p"])").find("would leave no room for a ball to the one at row 2, place 3"),
              std::string::npos);
    EXPECT_NE(with(R"("rows":["p"],"speed":99)").find("/levels/0/speed"), std::string::npos);
    EXPECT_NE(with(R"("rows":["p"],"colour":1)").find("colour"), std::string::npos);
    EXPECT_NE(with(R"("row":["p"])").find("row"), std::string::npos);
    EXPECT_NE(messageOf(R"({"squashout":1,"levels":[]})").find("must hold a level"), std::string::npos);
    EXPECT_NE(messageOf(R"({"squashout":2,"levels":[]})").find("/squashout"), std::string::npos);
    EXPECT_NE(messageOf("{").find("f.json"), std::string::npos);
    EXPECT_NE(with(R"("rows":"p")").find("/levels/0/rows"), std::string::npos);
}

TEST(Game, WhereTheBallLandsOnThePaddleIsWhereItGoes) {
    // The same ball on a paddle that is held a little more to the side each time.
    const LevelsPtr levels = levelOf(R"("","p")");
    double before = 10.0;
    int met = 0;
    for (double offset = -0.8; offset <= 0.81; offset += 0.2) {
        Game game(defOf(levels, 3));
        game.step({.launch = true});
        bool done = false;
        while (!done && !game.over() && game.steps() < 2000) {
            PlayInput input;
            input.has_target = true;
            if (!game.balls().empty()) {
                const Vec3 at = game.world().pose(game.balls()[0].body).position;
                const double target = (at.x - offset * game.paddle().half_width) / kHalfWidth;
                input.target = static_cast<std::int16_t>(32767.0 * std::clamp(target, -1.0, 1.0));
            }
            game.step(input);
            done = countOf({game.events().begin(), game.events().end()}, GameEventKind::PaddleHit) > 0;
        }
        ASSERT_TRUE(done);
        const Vec3 planned = game.balls()[0].planned;
        const double along = std::clamp((game.world().pose(game.balls()[0].body).position.x - game.paddle().x) /
                                            game.paddle().half_width,
                                        -1.0, 1.0);
        EXPECT_NEAR(std::atan2(planned.x, planned.y), kSteepestAim * along, 1e-6) << offset;
        // More to the right of the paddle, more to the right.
        EXPECT_LT(-std::atan2(planned.x, planned.y), before);
        before = -std::atan2(planned.x, planned.y);
        met += std::fabs(along - offset) < 0.25 ? 1 : 0;
        // And so it leaves, whatever the paddle does meanwhile.
        PlayInput away;
        away.axis = offset > 0 ? -127 : 127;
        while (!game.world().phase(game.balls()[0].body).is<elastoon::Flight>()) {
            game.step(away);
        }
        EXPECT_LT(glm::length(game.world().velocity(game.balls()[0].body) - planned), 1e-6);
    }
    EXPECT_GE(met, 5);
}

TEST(Game, EachKindDoesWhatItSays) {
    {
        Game game(defOf(levelOf(R"("","","","tttttttttt")")));
        const auto events = playUntil(game, GameEventKind::Popped);
        EXPECT_GE(countOf(events, GameEventKind::BlockHit), 2U) << "tin takes two";
    }
    {
        Game game(defOf(levelOf(R"("","","pppppppppp","oooooooooo")")));
        playUntil(game, GameEventKind::BallAdded);
        EXPECT_EQ(game.balls().size(), 2U);
    }
    {
        Game game(defOf(levelOf(R"("","","pppppppppp","wwwwwwwwww")")));
        playUntil(game, GameEventKind::Widened);
        EXPECT_DOUBLE_EQ(game.paddle().half_width, kPaddleHalfWidth * kWidePaddle);
    }
    {
        Game game(defOf(levelOf(R"("","","pppppppppp","hhhhhhhhhh")")));
        playUntil(game, GameEventKind::LifeGained);
        EXPECT_EQ(game.lives(), kLives + 1);
    }
    {
        Game game(defOf(levelOf(R"("","","pppppppppp","xxxxxxxxxx")")));
        const auto events = playUntil(game, GameEventKind::LevelCleared);
        EXPECT_EQ(countOf(events, GameEventKind::Exploded), 10U);
        EXPECT_EQ(countOf(events, GameEventKind::Popped), 20U) << "a chain, and all that is near";
        EXPECT_LE(countOf(events, GameEventKind::BlockHit), 5U);
    }
    {
        Game game(defOf(levelOf(R"("p","","","","","ssssssssss")")));
        Bot bot(7, 1.0);
        for (int i = 0; i < 6000 && !game.over(); ++i) {
            game.step(bot.play(game));
            EXPECT_EQ(countOf({game.events().begin(), game.events().end()}, GameEventKind::Popped), 0U);
        }
        EXPECT_EQ(game.blocks().size(), 11U) << "stone stays";
    }
    {
        Game game(defOf(levelOf(R"("","",".m........","","pppppppppp")", R"(,"moving":{"by":5,"period":2})")));
        std::set<double> places;
        for (int i = 0; i < 240; ++i) {
            game.step({});
            places.insert(game.blocks()[0].x);
        }
        EXPECT_NEAR(*places.rbegin() - *places.begin(), 5 * kColumnPitch, 1e-6);
        EXPECT_NEAR(game.blocks()[0].x, *places.begin(), 0.05) << "and back";
    }
}

TEST(Game, ACombosPointsGrow) {
    Game game(defOf(levelOf(R"("","","pppppppppp","xxxxxxxxxx")")));
    std::vector<int> points;
    for (const GameEvent& event : playUntil(game, GameEventKind::LevelCleared)) {
        if (event.kind == GameEventKind::Popped && event.block == BlockKind::Plain) {
            points.push_back(event.value);
        }
    }
    ASSERT_FALSE(points.empty());
    EXPECT_EQ(*std::max_element(points.begin(), points.end()), 10 * kMostCombo);
}

TEST(Game, WithoutAPlayerItIsLostAfterThreeBalls) {
    for (const bool gravity : {false, true}) {
        Game game(defOf(realLevels(), 11, gravity));
        int lost = 0;
        for (int i = 0; i < 60000 && !game.over(); ++i) {
            game.step({.launch = true, .axis = -127});
            lost += static_cast<int>(countOf({game.events().begin(), game.events().end()}, GameEventKind::LifeLost));
        }
        EXPECT_EQ(game.stage(), Stage::Lost);
        EXPECT_EQ(lost, kLives);
        EXPECT_EQ(game.lives(), 0);
    }
}

/// A chamber of stones: what comes in through its gap meets neither block nor paddle for long.
TEST(Game, ABallThatGoesRoundInCirclesIsNudged) {
    Game game(defOf(levelOf(R"("p","ssssssssss","","","","","ssss..ssss")"), 2));
    const auto events = playUntil(game, GameEventKind::Nudged, 600.0);
    std::size_t idle = 0;
    for (const GameEvent& event : events) {
        const bool useful = event.kind == GameEventKind::PaddleHit || event.kind == GameEventKind::Launched;
        const bool idles = event.kind == GameEventKind::WallHit ||
                           (event.kind == GameEventKind::BlockHit && event.block == BlockKind::Stone);
        idle = useful ? 0 : idle + (idles ? 1 : 0);
    }
    EXPECT_EQ(idle, static_cast<std::size_t>(kIdleImpacts));
}

TEST(Game, TheSameInputsGiveTheSameGame) {
    const LevelsPtr levels = realLevels();
    const Play play = playOfBot(levels, defOf(levels, 42), 0.9, 40.0);
    const Play again = valueOf(Play::fromJson(play.toJson(), "play"));
    EXPECT_EQ(again.inputs, play.inputs);
    EXPECT_EQ(valueOf(replay(again, levels)).hash(), play.hash);
    Play other = again;
    other.inputs[600].target = static_cast<std::int16_t>(other.inputs[600].target / 2 + 3000);
    const auto differs = replay(other, levels);
    ASSERT_FALSE(differs.ok());
    EXPECT_NE(differs.error().text().find("went another way"), std::string::npos);
    EXPECT_NE(playOfBot(levels, defOf(levels, 43), 0.9, 40.0).hash, play.hash);
}

/// The hash that web/game's test expects in Node and Chromium, too.
TEST(Game, TheRecordedPlayGoesAsRecorded) {
    const LevelsPtr levels = realLevels();
    for (const char* name : {"flat", "gravity"}) {
        std::ifstream stream(kSource + "/tests/golden/game-" + name + ".json");
        std::stringstream text;
        text << stream.rdbuf();
        const Play play = valueOf(Play::fromJson(text.str(), name));
        EXPECT_GT(play.inputs.size(), 5000U);
        const auto game = replay(play, levels);
        EXPECT_TRUE(game.ok()) << game.error().text();
    }
}

TEST(Game, PlaysAreRefusedWithTheirPlace) {
    const auto messageOf = [](const std::string& text) {
        const auto play = Play::fromJson(text, "f");
        return play ? std::string("taken") : play.error().text();
    };
    const std::string head = R"({"squashout_play":1,"seed":"0000000000000001","gravity":false,"first_level":0,)"
                             R"("hash":"0000000000000001","inputs":)";
    EXPECT_EQ(messageOf(head + "[]}"), "taken");
    EXPECT_EQ(messageOf(head + "[[1,0,0]]}"), "f: /inputs/0: must be [steps, launch, has_target, axis, target]");
    EXPECT_NE(messageOf(head + "[[1,0,0,200,0]]}").find("/inputs/0/3"), std::string::npos);
    EXPECT_NE(messageOf(head + "[[2000000,0,0,0,0],[2000000,0,0,0,0]]}").find("six hours"), std::string::npos);
    EXPECT_NE(messageOf(R"({"squashout_play":1})").find("seed"), std::string::npos);
    EXPECT_NE(messageOf(R"({"squashout_play":1,"seed":"12"})").find("16 hexadecimal digits"), std::string::npos);
}

TEST(Game, TheViewDrawsInBetween) {
    Game game(defOf(realLevels(), 5));
    View view;
    view.capture(game);
    Bot bot(5, 1.0);
    for (int i = 0; i < 400; ++i) {
        game.step(bot.play(game));
        view.capture(game);
        const auto now = view.drawn(1.0);
        const auto before = view.drawn(0.0);
        const auto between = view.drawn(0.5);
        ASSERT_EQ(now.size(), between.size());
        for (std::size_t k = 0; k < now.size(); ++k) {
            EXPECT_LT(glm::length(0.5 * (now[k].position + before[k].position) - between[k].position), 1e-12);
            // Squash keeps the volume.
            EXPECT_NEAR(glm::determinant(now[k].linear), 1.0, 1e-9);
        }
    }
}

TEST(Game, AResponseSquashesSwingsAndSettles) {
    const elastoon::Style jelly = *elastoon::styleNamed("jelly");
    const Response response(jelly, 0.5, 10.0, 2.0, {0, 1, 0}, {0, 0.25, 0});
    EXPECT_EQ(response.stretchAt(1.9), 1.0);
    double least = 1.0, most = 1.0, before = 1.0;
    for (double t = 2.0; t < 5.0; t += 1e-4) {
        const double s = response.stretchAt(t);
        EXPECT_LT(std::fabs(s - before), 0.02) << t; // no jump
        before = s;
        least = std::min(least, s);
        most = std::max(most, s);
    }
    EXPECT_LT(least, 0.75);
    EXPECT_GT(most, 1.02);
    EXPECT_EQ(before, 1.0);
    // The side that was hit stays where it is.
    Vec3 position(0.0);
    elastoon::Mat3 linear(1.0);
    response.apply(2.02, position, linear);
    EXPECT_NEAR(position.y + linear[1].y * 0.25, 0.25, 1e-12);
}

TEST(GameSoak, GamesOfTheBot) {
    constexpr int kGames = 12;
    SoakOptions options;
    options.games = kGames;
    options.longest = 30.0; // levels are begun in turn, so that short games show as much
    const SoakReport report = soak(realLevels(), options);
    EXPECT_TRUE(report.seen.holds()) << report.seen.depth << ' ' << report.seen.solid_depth << ' '
                                     << report.seen.deepest_where;
    EXPECT_GT(report.seen.looks, 100U * kGames);
    EXPECT_GT(report.seen.slowest, 0.5);
    EXPECT_LT(report.seen.fastest, 2.2);
    EXPECT_LT(report.seen.longest_contact, Seen::kMostContact);
    EXPECT_GT(report.pops, 10U * kGames);
    EXPECT_GT(report.blasts, 0U);
    EXPECT_GT(report.balls_added, 0U);
}

} // namespace
} // namespace squashout
