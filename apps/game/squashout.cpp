// See squashout.h.
#include "squashout.h"

#include "bot.h"
#include "play.h"
#include "view.h"

#include <algorithm>
#include <array>

using squashout::Game;
using squashout::Level;

struct Squashout {
    Game game;
    squashout::Bot bot;
    squashout::Play play;
    squashout::View view;
    std::vector<float> events, drawn, outline;
    std::array<double, kSquashoutNumbers> numbers{};
    std::string text;

    explicit Squashout(const squashout::GameDef& def, double skill) : game(def), bot(def.seed, skill) {
        play = {def.seed, def.gravity, def.first_level, {}, 0};
        view.capture(game);
    }
    void step(const squashout::PlayInput& input) {
        play.inputs.push_back(input);
        game.step(input);
        view.capture(game);
    }
};

namespace {

std::shared_ptr<const std::vector<Level>>& loaded() {
    static std::shared_ptr<const std::vector<Level>> levels;
    return levels;
}

std::string& lastError() {
    static std::string text;
    return text;
}

template <class... T>
void append(std::vector<float>& list, T... numbers) {
    (list.push_back(static_cast<float>(numbers)), ...);
}

} // namespace

const char* squashoutLoadLevels(const char* text, size_t length) {
    auto levels = squashout::parseLevels({text, length}, "levels");
    if (!levels) {
        lastError() = levels.error().text();
        return lastError().c_str();
    }
    loaded() = std::make_shared<const std::vector<Level>>(std::move(levels).value());
    return nullptr;
}

uint32_t squashoutLevelCount(void) {
    return loaded() ? static_cast<uint32_t>(loaded()->size()) : 0;
}

const char* squashoutLevelName(uint32_t level) {
    return level < squashoutLevelCount() ? (*loaded())[level].name.c_str() : nullptr;
}

Squashout* squashoutCreate(uint32_t seed, int gravity, uint32_t first_level, double skill) {
    if (!loaded()) {
        return nullptr;
    }
    squashout::GameDef def;
    def.levels = loaded();
    def.seed = seed;
    def.gravity = gravity != 0;
    def.first_level = first_level;
    return new Squashout(def, skill);
}

void squashoutDestroy(Squashout* game) {
    delete game;
}

void squashoutStep(Squashout* game, int launch, int has_target, int axis, int target) {
    squashout::PlayInput input;
    input.launch = launch != 0;
    input.has_target = has_target != 0;
    input.axis = static_cast<std::int8_t>(std::clamp(axis, -127, 127));
    input.target = static_cast<std::int16_t>(std::clamp(target, -32767, 32767));
    game->step(input);
}

void squashoutStepBot(Squashout* game) {
    game->step(game->bot.play(game->game));
}

const double* squashoutNumbers(Squashout* game) {
    const Game& g = game->game;
    double fastest = 0.0;
    double lowest = 1e9;
    double lowest_x = g.paddle().x;
    for (const squashout::Ball& ball : g.balls()) {
        const auto position = g.world().pose(ball.body).position;
        fastest = std::max(fastest, glm::length(g.world().velocity(ball.body)));
        lowest_x = position.y < lowest ? position.x : lowest_x;
        lowest = std::min(lowest, position.y);
    }
    game->numbers = {static_cast<double>(g.stage()),
                     static_cast<double>(g.score()),
                     static_cast<double>(g.lives()),
                     static_cast<double>(g.levelIndex()),
                     static_cast<double>(g.combo()),
                     static_cast<double>(g.balls().size()),
                     static_cast<double>(g.blocksLeft()),
                     static_cast<double>(g.steps()),
                     g.paddle().x,
                     g.paddle().half_width,
                     g.paddle().velocity,
                     g.paddle().wide_left,
                     fastest,
                     g.def().gravity ? 1.0 : 0.0,
                     static_cast<double>(g.escapes()),
                     lowest_x};
    return game->numbers.data();
}

const float* squashoutEvents(Squashout* game, uint32_t* out_count) {
    game->events.clear();
    for (const squashout::GameEvent& event : game->game.events()) {
        append(game->events, static_cast<int>(event.kind), static_cast<int>(event.block), event.id, event.x, event.y,
               event.normal_x, event.normal_y, event.speed, event.value);
    }
    *out_count = static_cast<uint32_t>(game->events.size() / kSquashoutEventFloats);
    return game->events.data();
}

const float* squashoutDrawn(Squashout* game, double share, uint32_t* out_count) {
    game->drawn.clear();
    for (const squashout::Drawn& drawn : game->view.drawn(std::clamp(share, 0.0, 1.0))) {
        append(game->drawn, static_cast<int>(drawn.what), static_cast<int>(drawn.block), drawn.id, drawn.extra);
        for (int column = 0; column < 3; ++column) {
            append(game->drawn, drawn.linear[column].x, drawn.linear[column].y, drawn.linear[column].z);
        }
        append(game->drawn, drawn.position.x, drawn.position.y, drawn.position.z);
    }
    *out_count = static_cast<uint32_t>(game->drawn.size() / kSquashoutDrawnFloats);
    return game->drawn.data();
}

const float* squashoutPaddleOutline(Squashout* game, double half_width, uint32_t* out_count) {
    game->outline.clear();
    for (const squashout::Vec3& point : Game::paddleOutline(half_width)) {
        append(game->outline, point.x, point.y);
    }
    *out_count = static_cast<uint32_t>(game->outline.size() / 2);
    return game->outline.data();
}

const double* squashoutSizes(void) {
    static const std::array<double, 7> kSizes{squashout::kHalfWidth,  squashout::kCeiling,     squashout::kBallRadius,
                                              squashout::kBlockWidth, squashout::kBlockHeight, squashout::kBlockDepth,
                                              squashout::kRoundBlock};
    return kSizes.data();
}

const char* squashoutHash(Squashout* game) {
    game->text = squashout::hexOf(game->game.hash());
    return game->text.c_str();
}

const char* squashoutRecording(Squashout* game) {
    game->play.hash = game->game.hash();
    game->text = game->play.toJson();
    return game->text.c_str();
}

Squashout* squashoutReplay(const char* text, size_t length) {
    const auto play = squashout::Play::fromJson({text, length}, "play");
    if (!play || !loaded()) {
        lastError() = play ? "no levels are loaded" : play.error().text();
        return nullptr;
    }
    squashout::GameDef def;
    def.levels = loaded();
    def.seed = play.value().seed;
    def.gravity = play.value().gravity;
    def.first_level = play.value().first_level;
    auto game = std::make_unique<Squashout>(def, 1.0);
    for (const squashout::PlayInput& input : play.value().inputs) {
        game->step(input);
    }
    if (game->game.hash() != play.value().hash) {
        lastError() = "went another way than when it was recorded: its hash is " + squashout::hexOf(game->game.hash());
        return nullptr;
    }
    return game.release();
}

const char* squashoutError(void) {
    return lastError().c_str();
}
