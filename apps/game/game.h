// Squashout's rules: a world of the library, what a player does to it in steps of 1/120 s, and what comes of it. No
// drawing, no clock; the same seed and inputs give the same game on every machine. docs/game.md.
#pragma once

#include "../seeded_random.h"
#include "level.h"
#include "response.h"
#include "tuning.h"

#include "elastoon/world.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace squashout {

using Random = elastoon::SeededRandom;

using elastoon::BodyId;
using elastoon::ObstacleId;
using elastoon::Vec3;

/// What a player does in one step. Small whole numbers: the same from a file, a network or a page.
struct PlayInput {
    bool launch = false;      ///< lets the ball go; after a level, goes on to the next
    bool has_target = false;  ///< of mouse and touch: the paddle goes to `target`
    std::int8_t axis = 0;     ///< of keys and stick: -127 left .. 127 right; read without a target
    std::int16_t target = 0;  ///< -32767 left wall .. 32767 right wall

    friend bool operator==(const PlayInput&, const PlayInput&) = default;
};

enum class Stage : std::uint8_t {
    Ready,    ///< a ball on the paddle
    Playing,
    Cleared,  ///< between levels
    Won,      ///< all levels
    Lost,
};

enum class GameEventKind : std::uint8_t {
    LevelBegun, ///< value: its number from 0
    Launched,
    WallHit,
    PaddleHit,
    BlockHit,
    Popped,   ///< value: points
    Exploded,
    BallLost,
    LifeLost, ///< value: lives left
    BallAdded,
    Widened,
    Narrowed,
    LifeGained,
    LevelCleared,
    GameWon,
    GameLost,
    Nudged, ///< a ball that went round in circles got another way
};

/// What happened in the last step, for the view.
struct GameEvent {
    GameEventKind kind = GameEventKind::Launched;
    BlockKind block = BlockKind::Plain; ///< of BlockHit, Popped, Exploded
    std::uint32_t id = 0;               ///< of the ball or block
    double x = 0.0, y = 0.0;            ///< where, m
    double normal_x = 0.0, normal_y = 0.0; ///< of a hit, towards the ball
    double speed = 0.0;                 ///< of a hit, m/s
    int value = 0;
};

struct Ball {
    std::uint32_t id = 0;
    BodyId body;
    Vec3 planned{0.0};    ///< what the impact that it is in will leave it with
    int idle_impacts = 0; ///< since a block or the paddle
    bool hurried = false; ///< a jelly threw it back
    bool crushed = false; ///< it has no room anywhere near: it is lost
};

struct LiveBlock {
    std::uint32_t id = 0;
    BlockKind kind = BlockKind::Plain;
    int hits_left = 1;
    ObstacleId obstacle;
    double x = 0.0, y = 0.0; ///< of the middle, now
    bool dying = false;      ///< pops when the ball that hit it parts from it
    std::uint64_t fuse = 0;  ///< step at which a blast takes it; 0: none
    Response response;
};

struct Paddle {
    ObstacleId obstacle;
    double x = 0.0, velocity = 0.0, lean = 0.0; ///< m, m/s, rad (to the left above 0)
    double half_width = kPaddleHalfWidth;
    double wide_left = 0.0; ///< s
    Response response;
};

struct GameDef {
    std::shared_ptr<const std::vector<Level>> levels; ///< not empty
    std::uint64_t seed = 1;
    bool gravity = false;
    std::uint32_t first_level = 0; ///< beyond the last: the last
};

class Game {
public:
    explicit Game(const GameDef& def);

    void step(const PlayInput& input);

    [[nodiscard]] std::span<const GameEvent> events() const { return events_; } ///< of the last step
    [[nodiscard]] Stage stage() const { return stage_; }
    [[nodiscard]] bool over() const { return stage_ == Stage::Won || stage_ == Stage::Lost; }
    [[nodiscard]] int score() const { return score_; }
    [[nodiscard]] int lives() const { return lives_; }
    [[nodiscard]] std::size_t levelIndex() const { return level_; }
    [[nodiscard]] const Level& level() const { return (*def_.levels)[level_]; }
    [[nodiscard]] int combo() const { return combo_; } ///< blocks since the paddle was touched
    [[nodiscard]] std::uint64_t steps() const { return steps_; }
    [[nodiscard]] const GameDef& def() const { return def_; }
    [[nodiscard]] const elastoon::World& world() const { return *world_; }
    [[nodiscard]] std::span<const Ball> balls() const { return balls_; }
    [[nodiscard]] std::span<const LiveBlock> blocks() const { return blocks_; }
    [[nodiscard]] const Paddle& paddle() const { return paddle_; }
    /// Blocks that must still break.
    [[nodiscard]] std::size_t blocksLeft() const;
    /// Where a ball that waits on the paddle is drawn.
    [[nodiscard]] Vec3 waitingBall() const;
    /// Time of the level's world, s.
    [[nodiscard]] double time() const { return world_->time(); }
    /// 64 bits over all of it: equal games have equal hashes, on every machine.
    [[nodiscard]] std::uint64_t hash() const;
    /// Balls that were found outside the field and put back. Stays 0 as long as nothing tunnels.
    [[nodiscard]] int escapes() const { return escapes_; }

    /// The paddle's outline for views: points of its upper edge from left to right about its foot's middle.
    [[nodiscard]] static std::vector<Vec3> paddleOutline(double half_width);

private:
    // game.cpp
    void beginLevel(std::size_t level);
    void note(GameEvent event) { events_.push_back(event); }
    void advanceStage(const PlayInput& input);
    void clearLevel();
    // paddle.cpp
    void addPaddle(double x, double half_width);
    void movePaddle(const PlayInput& input);
    void changeWidth();
    [[nodiscard]] bool roomAroundPaddle(double half_width) const;
    // balls.cpp
    void launch();
    void addWaitingBalls();
    bool addBall(const Vec3& position, const Vec3& direction, bool may_be_refused);
    void meet(const elastoon::Event& event);
    void hitPaddle(Ball& ball, const elastoon::Event& event);
    void hitBlock(Ball& ball, LiveBlock& block, const elastoon::Event& event);
    [[nodiscard]] Vec3 wayAfter(Ball& ball, const elastoon::Event& event);
    void steer(Ball& ball, const Vec3& velocity);
    void holdCourse();
    void keepGoing(Ball& ball);
    void setFree(Ball& ball, const Vec3& velocity);
    void loseBalls();
    [[nodiscard]] double speedAt(const Ball& ball, double y) const;
    [[nodiscard]] Vec3 bentToBlocks(const Vec3& position, const Vec3& direction) const;
    // blocks.cpp
    void addBlock(const LevelBlock& def);
    void burnFuses();
    void popBlocks();
    void pop(std::size_t index);
    void blast(const LiveBlock& bomb);
    void reward(const LiveBlock& block);
    LiveBlock* blockOf(ObstacleId id);

    GameDef def_;
    Random random_;
    std::optional<elastoon::World> world_;
    std::vector<GameEvent> events_;
    Stage stage_ = Stage::Ready;
    int score_ = 0, lives_ = kLives, combo_ = 0, escapes_ = 0;
    std::size_t level_ = 0;
    std::uint64_t steps_ = 0;
    double since_stage_ = 0.0; ///< s
    double since_pop_ = 0.0;   ///< s, of playing
    double speed_up_ = 1.0;
    std::uint32_t next_id_ = 1;
    std::vector<Ball> balls_;
    std::vector<LiveBlock> blocks_;
    Paddle paddle_;
    std::vector<Vec3> waiting_balls_; ///< let out, but not yet room to be
    double wanted_half_width_ = kPaddleHalfWidth;
    elastoon::ShapePtr ball_shape_, block_shape_, round_shape_;
};

} // namespace squashout
