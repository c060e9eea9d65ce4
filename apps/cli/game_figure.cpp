// See game_figure.h.
#include "game_figure.h"

#include "play.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

namespace elastoon {

namespace {

using squashout::Game;
using squashout::GameEventKind;
using squashout::LiveBlock;

constexpr double kGone = 1e4; ///< m, behind all that is seen
constexpr double kMoment = 2e-3;
const Vec3 kPaper{0.93, 0.92, 0.90}; ///< what pale things are mixed with
const Vec3 kBallColor{0.90, 0.34, 0.18};
const Vec3 kPaddleColor{0.18, 0.55, 0.53};
const Vec3 kWallColor{0.62, 0.64, 0.68};

Vec3 colorOf(squashout::BlockKind kind) {
    switch (kind) {
    case squashout::BlockKind::Tough:
        return {0.55, 0.60, 0.68};
    case squashout::BlockKind::Jelly:
        return {0.36, 0.75, 0.50};
    default:
        return {0.95, 0.72, 0.35};
    }
}

Vec3 pale(const Vec3& color) {
    constexpr double kShare = 0.72;
    return color * (1.0 - kShare) + kPaper * kShare;
}

struct Seen {
    LiveBlock block;
    ObstacleDef def;
    double popped_at = -1.0;
};

/// What the play showed besides the ball.
struct Watched {
    std::map<std::uint32_t, Seen> blocks; ///< by id
    ObstacleDef paddle;                   ///< with its way
    std::vector<std::pair<Vec3, Quat>> touched; ///< where the paddle was
    double launched_at = 0.0;
};

void addObstacle(Scene& scene, const std::string& name, const ObstacleDef& def, const Vec3& color) {
    SceneObstacle obstacle;
    obstacle.name = name;
    obstacle.def = def;
    obstacle.color = color;
    obstacle.shape = scene.shapes.size();
    scene.shapes.push_back({name, def.shape, {}});
    scene.obstacles.push_back(obstacle);
}

void addWalls(Scene& scene) {
    constexpr double kThick = 0.3;
    constexpr double kTall = squashout::kCeiling + kThick;
    const auto wall = [&](const char* name, const Vec3& size, const Vec3& middle) {
        ObstacleDef def;
        def.shape = Shape::box(size).value();
        def.position = middle;
        addObstacle(scene, name, def, kWallColor);
    };
    for (const double side : {-1.0, 1.0}) {
        wall(side < 0 ? "left wall" : "right wall", {kThick, kTall, 1.2},
             {side * (squashout::kHalfWidth + 0.5 * kThick), 0.5 * kTall, 0.0});
    }
    wall("ceiling", {2.0 * squashout::kHalfWidth, kThick, 1.2}, {0.0, squashout::kCeiling + 0.5 * kThick, 0.0});
}

Scene basis(const Game& game, const Watched& watched) {
    constexpr double kEvery = 0.05;
    Scene scene;
    scene.name = "Figure 8: a game";
    scene.gravity = Vec3(0.0);
    scene.duration = game.time();
    scene.camera = SceneCamera{{0.0, 7.0, 42.0}, {0.0, 8.1, 0.0}, 23.5};
    scene.strobe = {.every = kEvery, .from = watched.launched_at + kMoment, .to = game.time()};
    addWalls(scene);
    return scene;
}

Scene pictureOf(const Game& game, const Watched& watched) {
    Scene scene = basis(game, watched);
    for (const auto& [id, seen] : watched.blocks) {
        const Vec3 color = colorOf(seen.block.kind);
        addObstacle(scene, "block", seen.def, seen.popped_at >= 0.0 ? pale(color) : color);
    }
    ObstacleDef paddle = watched.paddle;
    paddle.path.clear();
    for (std::size_t i = 0; i < watched.touched.size(); ++i) {
        std::tie(paddle.position, paddle.rotation) = watched.touched[i];
        paddle.position.z =
            i + 1 == watched.touched.size() ? 0.0 : -0.3 * static_cast<double>(i + 1); // none in another
        addObstacle(scene, "paddle", paddle, i + 1 == watched.touched.size() ? kPaddleColor : pale(kPaddleColor));
    }
    return scene;
}

Scene filmOf(const Game& game, const Watched& watched) {
    Scene scene = basis(game, watched);
    for (const auto& [id, seen] : watched.blocks) {
        ObstacleDef def = seen.def;
        if (seen.popped_at >= 0.0) {
            const Vec3 gone = def.position - Vec3(0.0, 0.0, kGone);
            def.path = {{seen.popped_at, def.position, def.rotation},
                        {seen.popped_at + kMoment * 10.0, gone, def.rotation}};
        }
        addObstacle(scene, "block", def, colorOf(seen.block.kind));
    }
    addObstacle(scene, "paddle", watched.paddle, kPaddleColor);
    return scene;
}

std::string textOf(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
}

void watch(const Game& game, Watched& watched) {
    const World& world = game.world();
    const MovingFrame& paddle = world.frame(game.paddle().obstacle);
    const Vec3 place = paddle.originAt(world.time());
    const Quat turn = paddle.orientationAt(world.time());
    watched.paddle.shape = world.shape(game.paddle().obstacle);
    watched.paddle.path.push_back({world.time(), place, turn});
    for (const squashout::GameEvent& event : game.events()) {
        if (event.kind == GameEventKind::Launched) {
            watched.launched_at = world.time() - squashout::kStep;
            watched.touched.emplace_back(place, turn);
        } else if (event.kind == GameEventKind::PaddleHit) {
            watched.touched.emplace_back(place, turn);
        } else if (event.kind == GameEventKind::Popped) {
            watched.blocks[event.id].popped_at = world.time();
        }
    }
}

} // namespace

Result<PlayedSequence> playSequence(const std::string& folder) {
    auto levels = squashout::readLevels(folder + "/levels.json");
    if (!levels) {
        return levels.error();
    }
    const std::string file = folder + "/play.json";
    const auto play = squashout::Play::fromJson(textOf(file), file);
    if (!play) {
        return play.error();
    }
    squashout::GameDef def;
    def.levels = std::make_shared<const std::vector<squashout::Level>>(std::move(levels).value());
    def.seed = play.value().seed;
    def.gravity = play.value().gravity;
    Game game(def);
    Watched watched;
    for (const LiveBlock& block : game.blocks()) {
        Seen& seen = watched.blocks[block.id];
        seen.block = block;
        seen.def.shape = game.world().shape(block.obstacle);
        seen.def.position = {block.x, block.y, 0.0};
    }
    const MovingFrame& paddle = game.world().frame(game.paddle().obstacle);
    watched.paddle.position = paddle.origin;
    PlayedSequence sequence;
    sequence.timeline.begin(game.world());
    for (const squashout::PlayInput& input : play.value().inputs) {
        game.step(input);
        sequence.timeline.capture(game.world());
        watch(game, watched);
    }
    if (game.hash() != play.value().hash) {
        return Error{"went another way than when it was recorded: its hash is " + squashout::hexOf(game.hash()), file};
    }
    if (sequence.timeline.tracks().size() != 1) {
        return Error{"must be a play with one ball from the launch on", file};
    }
    sequence.scene = pictureOf(game, watched);
    sequence.film = filmOf(game, watched);
    for (Scene* scene : {&sequence.scene, &sequence.film}) {
        SceneBody ball;
        ball.name = "ball";
        ball.shape = scene->shapes.size();
        ball.def.shape = sequence.timeline.tracks().front().shape();
        ball.def.style = squashout::ballStyle();
        ball.color = kBallColor;
        scene->shapes.push_back({"ball", ball.def.shape, {}});
        scene->bodies.push_back(ball);
    }
    return sequence;
}

} // namespace elastoon
