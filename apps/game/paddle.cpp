// The paddle: it goes where the player wants, leans into its motion, and grows and shrinks where there is room.
#include "game.h"

#include "dmath.h"

#include <algorithm>
#include <cmath>

namespace squashout {

using elastoon::Quat;

namespace {

constexpr double kRim = 0.3; ///< the ends slope by this, so that they lift a ball rather than press it to a wall
constexpr double kHalfDepth = 0.6;
constexpr int kTopPoints = 9;
/// Of the way to a target in one step: it arrives within a few, without a jerk.
constexpr double kTargetShare = 0.45;
constexpr double kLeanShare = 0.12;
/// So near it is there, m and rad: a paddle that is not moved stands still.
constexpr double kThere = 2e-3;
constexpr double kLeansThere = 2e-3;

double clamped(double value, double most) {
    return std::clamp(value, -most, most);
}

} // namespace

std::vector<Vec3> Game::paddleOutline(double half_width) {
    std::vector<Vec3> outline{{-half_width, 0.0, 0.0}};
    for (int i = 0; i < kTopPoints; ++i) {
        const double along = 2.0 * i / (kTopPoints - 1) - 1.0;
        outline.emplace_back(along * (half_width - kRim), kPaddleHeight + kPaddleDome * (1.0 - along * along), 0.0);
    }
    outline.emplace_back(half_width, 0.0, 0.0);
    return outline;
}

void Game::addPaddle(double x, double half_width) {
    std::vector<Vec3> points;
    for (const Vec3& point : paddleOutline(half_width)) {
        points.push_back(point + Vec3(0.0, 0.0, kHalfDepth));
        points.push_back(point - Vec3(0.0, 0.0, kHalfDepth));
    }
    elastoon::ObstacleDef def;
    def.shape = elastoon::Shape::hull(points).value();
    const double most = kHalfWidth - half_width;
    def.position = Vec3(clamped(x, most), kPaddleFoot, 0.0) + def.shape->centroidOfInput();
    paddle_.obstacle = world_->addObstacle(def).value();
    paddle_.x = def.position.x;
    paddle_.velocity = paddle_.lean = 0.0;
    paddle_.half_width = wanted_half_width_ = half_width;
    paddle_.wide_left = half_width > kPaddleHalfWidth ? paddle_.wide_left : 0.0;
    paddle_.response = {};
}

void Game::movePaddle(const PlayInput& input) {
    constexpr double kMostAxis = 127.0, kMostTarget = 32767.0;
    const double before = paddle_.velocity;
    if (input.has_target) {
        const double target = input.target / kMostTarget * kHalfWidth;
        const double way = target - paddle_.x;
        paddle_.velocity = std::fabs(way) < kThere ? 0.0 : clamped(way * kTargetShare / kStep, kPaddleMostSpeed);
    } else {
        const double wanted = clamped(input.axis / kMostAxis, 1.0) * kPaddleKeySpeed;
        paddle_.velocity = before + clamped(wanted - before, kPaddleKeyPush * kStep);
    }
    const double most = kHalfWidth - paddle_.half_width;
    paddle_.velocity = clamped(paddle_.x + paddle_.velocity * kStep, most) - paddle_.x;
    paddle_.velocity /= kStep;
    changeWidth();
    const Quat turn = world_->frame(paddle_.obstacle).orientationAt(world_->time());
    paddle_.lean = 2.0 * elastoon::detAtan2(turn.z, turn.w);
    const double wanted_lean = -kMostLean * clamped(paddle_.velocity / kPaddleKeySpeed, 1.0);
    const double to_lean = wanted_lean - paddle_.lean;
    const Vec3 velocity{paddle_.velocity, 0.0, 0.0};
    const Vec3 turning{0.0, 0.0, std::fabs(to_lean) < kLeansThere ? 0.0 : to_lean * kLeanShare / kStep};
    // Every change lets all balls look ahead anew.
    const elastoon::MovingFrame& frame = world_->frame(paddle_.obstacle);
    if (frame.velocity != velocity || frame.angular_velocity != turning) {
        (void)world_->setObstacleMotion(paddle_.obstacle, velocity, turning);
    }
}

/// A wider paddle must not come to be inside a ball.
bool Game::roomAroundPaddle(double half_width) const {
    constexpr double kClear = 1.2;
    return std::all_of(balls_.begin(), balls_.end(), [&](const Ball& ball) {
        const Vec3 position = world_->pose(ball.body).position;
        return position.y > kPaddleFoot + kPaddleHeight + kClear ||
               std::fabs(position.x - paddle_.x) > half_width + kClear;
    });
}

void Game::changeWidth() {
    if (paddle_.wide_left > 0.0 && stage_ == Stage::Playing) {
        paddle_.wide_left -= kStep;
    }
    wanted_half_width_ = kPaddleHalfWidth * (paddle_.wide_left > 0.0 ? kWidePaddle : 1.0);
    if (wanted_half_width_ == paddle_.half_width ||
        !roomAroundPaddle(std::max(wanted_half_width_, paddle_.half_width))) {
        return;
    }
    const bool wider = wanted_half_width_ > paddle_.half_width;
    const double velocity = paddle_.velocity;
    world_->removeObstacle(paddle_.obstacle);
    addPaddle(paddle_.x, wanted_half_width_);
    const double most = kHalfWidth - paddle_.half_width;
    paddle_.velocity = (clamped(paddle_.x + velocity * kStep, most) - paddle_.x) / kStep;
    note({.kind = wider ? GameEventKind::Widened : GameEventKind::Narrowed, .x = paddle_.x, .y = kPaddleFoot});
}

} // namespace squashout
