// The course of a game: levels, stages, and the order of a step. See game.h.
#include "game.h"

#include "hash.h"

#include <algorithm>

namespace squashout {

using elastoon::ObstacleDef;
using elastoon::Shape;

namespace {

constexpr int kCutsOfBall = 4; ///< 66 vertices: round enough for contacts, and quick

void addWall(elastoon::World& world, const Vec3& normal, double offset) {
    (void)world.addObstacle(ObstacleDef::plane(normal, offset)).value();
}

} // namespace

Game::Game(const GameDef& def)
    : def_(def),
      random_(def.seed),
      ball_shape_(Shape::sphere(kBallRadius, kCutsOfBall).value()),
      block_shape_(Shape::box({kBlockWidth, kBlockHeight, kBlockDepth}).value()),
      round_shape_(Shape::sphere(kRoundBlock, kCutsOfBall).value()) {
    beginLevel(std::min<std::size_t>(def.first_level, def.levels->size() - 1));
}

void Game::beginLevel(std::size_t level) {
    level_ = level;
    const Vec3 gravity{0.0, def_.gravity ? -this->level().gravity : 0.0, 0.0};
    world_.emplace(elastoon::World::create({.gravity = gravity, .parallel_for = {}}).value());
    addWall(*world_, {1, 0, 0}, -kHalfWidth);
    addWall(*world_, {-1, 0, 0}, -kHalfWidth);
    addWall(*world_, {0, -1, 0}, -kCeiling);
    balls_.clear();
    blocks_.clear();
    waiting_balls_.clear();
    addPaddle(paddle_.x, kPaddleHalfWidth);
    for (const LevelBlock& block : this->level().blocks) {
        addBlock(block);
    }
    stage_ = Stage::Ready;
    since_stage_ = since_pop_ = 0.0;
    speed_up_ = 1.0;
    combo_ = 0;
    note({.kind = GameEventKind::LevelBegun, .value = static_cast<int>(level)});
}

void Game::step(const PlayInput& input) {
    if (steps_ > 0) { // the first step tells of the level's beginning
        events_.clear();
    }
    ++steps_;
    advanceStage(input);
    movePaddle(input);
    burnFuses();
    addWaitingBalls();
    holdCourse();
    world_->step(kStep);
    paddle_.x = world_->frame(paddle_.obstacle).originAt(world_->time()).x;
    for (LiveBlock& block : blocks_) {
        const Vec3 middle = world_->frame(block.obstacle).originAt(world_->time());
        block.response.carry(middle - Vec3(block.x, block.y, 0.0));
        block.x = middle.x;
        block.y = middle.y;
    }
    const std::vector<elastoon::Event> met(world_->events().begin(), world_->events().end());
    for (const elastoon::Event& event : met) {
        if (event.type == elastoon::EventType::Impact) {
            meet(event);
        }
    }
    popBlocks();
    for (Ball& ball : balls_) {
        keepGoing(ball);
    }
    loseBalls();
    if (stage_ == Stage::Playing && blocksLeft() == 0) {
        clearLevel();
    }
}

void Game::advanceStage(const PlayInput& input) {
    since_stage_ += kStep;
    since_pop_ += stage_ == Stage::Playing ? kStep : 0.0;
    if (stage_ == Stage::Ready && (input.launch || since_stage_ > kLaunchesItself)) {
        launch();
    } else if (stage_ == Stage::Cleared && (since_stage_ > kCelebration || (input.launch && since_stage_ > 0.5))) {
        if (level_ + 1 < def_.levels->size()) {
            beginLevel(level_ + 1);
        } else {
            stage_ = Stage::Won;
            note({.kind = GameEventKind::GameWon, .value = score_});
        }
    }
}

void Game::clearLevel() {
    for (const Ball& ball : balls_) {
        world_->removeBody(ball.body);
    }
    balls_.clear();
    waiting_balls_.clear();
    stage_ = Stage::Cleared;
    since_stage_ = 0.0;
    note({.kind = GameEventKind::LevelCleared, .value = static_cast<int>(level_)});
}

std::size_t Game::blocksLeft() const {
    return static_cast<std::size_t>(std::count_if(
        blocks_.begin(), blocks_.end(), [](const LiveBlock& block) { return traitsOf(block.kind).hits > 0; }));
}

std::uint64_t Game::hash() const {
    elastoon::Hash hash;
    hash.add(world_->stateHash());
    for (const std::uint64_t number :
         {steps_, random_.state(), std::uint64_t{level_}, static_cast<std::uint64_t>(stage_),
          static_cast<std::uint64_t>(score_), static_cast<std::uint64_t>(lives_), std::uint64_t{blocks_.size()}}) {
        hash.add(number);
    }
    for (const double number : {paddle_.x, paddle_.velocity, paddle_.lean, paddle_.half_width, speed_up_, since_pop_}) {
        hash.add(number);
    }
    for (const LiveBlock& block : blocks_) {
        hash.add(static_cast<std::uint64_t>(block.hits_left));
        hash.add(block.x);
        hash.add(block.response.stretchAt(world_->time()));
    }
    return hash.value();
}

} // namespace squashout
