// Balls: what they meet and how they leave it. The library gives every impact; the rules steer its outcome.
#include "game.h"

#include "dmath.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace squashout {

using elastoon::detAtan2;
using elastoon::detSinCos;
using elastoon::Flight;
using elastoon::Impact;

namespace {

constexpr double kSameSpeed = 1e-6; ///< m/s
/// Parting from a surface slower than this, a ball would be overtaken by it again.
constexpr double kLeastParting = 1.5;
constexpr double kStuckSpeed = 0.45; ///< of the level's: below, something went wrong
/// Below this share of its speed along the normal a ball grazes: without a squash it flies on.
constexpr double kGrazes = 0.5, kGrazesPaddle = 0.2;
constexpr double kNudgeFrom = 0.14, kNudgeTo = 0.30; ///< rad

Vec3 flat(const Vec3& v) {
    return {v.x, v.y, 0.0};
}

Vec3 turned(const Vec3& direction, double angle) {
    const auto [sine, cosine] = detSinCos(angle);
    return {direction.x * cosine - direction.y * sine, direction.x * sine + direction.y * cosine, 0.0};
}

/// At least kFlattestWay from level, up or down as it was.
Vec3 steepEnough(const Vec3& direction) {
    const auto [sine, cosine] = detSinCos(kFlattestWay);
    if (std::fabs(direction.y) >= sine) {
        return direction;
    }
    return {direction.x < 0.0 ? -cosine : cosine, direction.y < 0.0 ? -sine : sine, 0.0};
}

Vec3 unit(const Vec3& v, const Vec3& otherwise) {
    const double length = glm::length(v);
    return length > 1e-9 ? v / length : otherwise;
}

/// Where and how fast something was hit, for the view.
GameEvent hitOf(GameEventKind kind, std::uint32_t id, const elastoon::Event& event) {
    return {.kind = kind,
            .id = id,
            .x = event.point.x,
            .y = event.point.y,
            .normal_x = event.normal.x,
            .normal_y = event.normal.y,
            .speed = event.speed};
}

} // namespace

/// The level's speed, with gravity less the higher it is: nothing crawls, and every ball reaches the ceiling.
double Game::speedAt(const Ball& ball, double y) const {
    const double pull = def_.gravity ? level().gravity : 0.0;
    const double below = level().speed * speed_up_ * (ball.hurried ? kJellySpeed : 1.0);
    // As if it had the level's speed half-way up.
    const double squared = below * below + 2.0 * pull * (0.5 * kCeiling - y);
    return std::sqrt(std::max(squared, 0.25 * below * below));
}

Vec3 Game::waitingBall() const {
    return {paddle_.x, kPaddleFoot + kPaddleHeight + kPaddleDome + kBallRadius, 0.0};
}

bool Game::addBall(const Vec3& position, const Vec3& direction, bool may_be_refused) {
    Ball ball;
    ball.id = next_id_;
    elastoon::BodyDef def;
    def.shape = ball_shape_;
    def.style = ballStyle();
    def.position = position;
    def.velocity = direction * speedAt(ball, position.y);
    const auto added = world_->addBody(def);
    if (!added) {
        // The paddle leans: a little higher there is room.
        return !may_be_refused && addBall(position + Vec3(0.0, 0.1, 0.0), direction, position.y > 0.5 * kCeiling);
    }
    ++next_id_;
    ball.body = added.value();
    ball.planned = def.velocity;
    balls_.push_back(ball);
    return true;
}

void Game::launch() {
    const double angle = random_.uniform(-0.35, 0.35) - 0.6 * paddle_.velocity / kPaddleMostSpeed;
    const Vec3 direction = turned({0.0, 1.0, 0.0}, angle);
    constexpr double kRoom = 0.15; // a ball that flies is longer
    stage_ = Stage::Playing;
    since_stage_ = since_pop_ = 0.0;
    combo_ = 0;
    (void)addBall(waitingBall() + Vec3(0.0, kRoom, 0.0), direction, false);
    note({.kind = GameEventKind::Launched, .x = paddle_.x, .y = waitingBall().y});
}

/// A ball that a block let out is there as soon as it has room to fly somewhere.
void Game::addWaitingBalls() {
    constexpr int kWays = 8;
    for (std::size_t i = 0; i < waiting_balls_.size();) {
        bool done = balls_.size() >= kMostBalls;
        const double first = random_.uniform(0.0, 2.0 * elastoon::kPi);
        for (int k = 0; k < kWays && !done; ++k) {
            const Vec3 direction = steepEnough(turned({1.0, 0.0, 0.0}, first + k * 2.0 * elastoon::kPi / kWays));
            done = addBall(waiting_balls_[i], direction, true);
            if (done) {
                note({.kind = GameEventKind::BallAdded,
                      .id = balls_.back().id,
                      .x = waiting_balls_[i].x,
                      .y = waiting_balls_[i].y});
            }
        }
        if (done) {
            waiting_balls_.erase(waiting_balls_.begin() + static_cast<std::ptrdiff_t>(i));
        } else {
            ++i;
        }
    }
}

void Game::meet(const elastoon::Event& event) {
    const auto found =
        std::find_if(balls_.begin(), balls_.end(), [&](const Ball& ball) { return ball.body == event.body; });
    if (found == balls_.end()) {
        return;
    }
    Ball& ball = *found;
    ++ball.idle_impacts;
    ball.hurried = false;
    if (event.other == paddle_.obstacle) {
        hitPaddle(ball, event);
        return;
    }
    if (LiveBlock* block = blockOf(event.other)) {
        hitBlock(ball, *block, event);
    } else {
        note(hitOf(GameEventKind::WallHit, ball.id, event));
    }
    const Vec3 position = world_->pose(ball.body).position;
    steer(ball, wayAfter(ball, event) * speedAt(ball, position.y));
}

/// Where it lands on the paddle is where it goes.
void Game::hitPaddle(Ball& ball, const elastoon::Event& event) {
    ball.idle_impacts = 0;
    combo_ = 0;
    speed_up_ = std::min(speed_up_ * kSpeedUp, kMostSpeedUp);
    const Vec3 position = world_->pose(ball.body).position;
    const double along = std::clamp((position.x - paddle_.x) / paddle_.half_width, -1.0, 1.0);
    Vec3 direction = turned({0.0, 1.0, 0.0}, -kSteepestAim * along);
    direction = bentToBlocks(position, direction);
    paddle_.response = Response(*elastoon::styleNamed("mochi"), 2.0 * kPaddleHeight, event.speed, event.time,
                                {0.0, 1.0, 0.0}, {paddle_.x, kPaddleFoot + kPaddleHeight + kPaddleDome, 0.0});
    note(hitOf(GameEventKind::PaddleHit, ball.id, event));
    steer(ball, direction * speedAt(ball, position.y));
}

void Game::hitBlock(Ball& ball, LiveBlock& block, const elastoon::Event& event) {
    const KindTraits& traits = traitsOf(block.kind);
    ball.idle_impacts = traits.hits > 0 ? 0 : ball.idle_impacts;
    ball.hurried = block.kind == BlockKind::Jelly;
    const Vec3 axis = unit(flat(event.normal), {0.0, 1.0, 0.0});
    const double length =
        traits.is_round ? 2.0 * kRoundBlock : std::fabs(axis.x) * kBlockWidth + std::fabs(axis.y) * kBlockHeight;
    block.response = Response(*elastoon::styleNamed(traits.style), length, event.speed, event.time, axis, event.point);
    if (traits.hits > 0 && !block.dying) {
        --block.hits_left;
        block.dying = block.hits_left <= 0;
    }
    GameEvent hit = hitOf(GameEventKind::BlockHit, block.id, event);
    hit.block = block.kind;
    hit.value = block.hits_left;
    note(hit);
}

/// The direction in which the library throws it back, never too flat; another one where it went round in circles.
Vec3 Game::wayAfter(Ball& ball, const elastoon::Event& event) {
    const elastoon::Phase& phase = world_->phase(ball.body);
    const auto* impact = phase.as<Impact>();
    const Vec3 normal = flat(event.normal);
    Vec3 velocity = flat(world_->velocity(ball.body));
    if (impact != nullptr && phase.obstacle == event.other) {
        const elastoon::MovingFrame& frame = impact->surface.frame;
        velocity = flat(frame.velocityAt(world_->time(), event.point) +
                        frame.orientationAt(world_->time()) * impact->velocity_out);
    }
    Vec3 direction = unit(velocity, normal);
    const Vec3 position = world_->pose(ball.body).position;
    direction = bentToBlocks(position, direction);
    if (ball.idle_impacts >= kIdleImpacts) {
        const double angle = random_.uniform(kNudgeFrom, kNudgeTo);
        direction = turned(direction, random_.uniform(-1.0, 1.0) < 0.0 ? -angle : angle);
        ball.idle_impacts = kIdleImpacts / 2;
        note({.kind = GameEventKind::Nudged, .id = ball.id, .x = position.x, .y = position.y});
    }
    return steepEnough(direction);
}

/// Where nothing has popped for long, a little towards the nearest block that must.
Vec3 Game::bentToBlocks(const Vec3& position, const Vec3& direction) const {
    if (since_pop_ < kHelpAfter) {
        return direction;
    }
    double best = 4.0;
    Vec3 towards(0.0);
    for (const LiveBlock& block : blocks_) {
        const Vec3 way = unit(Vec3(block.x, block.y, 0.0) - flat(position), direction);
        const double off = 1.0 - glm::dot(way, direction);
        if (traitsOf(block.kind).hits > 0 && off < best) {
            best = off;
            towards = way;
        }
    }
    if (towards == Vec3(0.0)) {
        return direction;
    }
    const double angle = detAtan2(direction.x * towards.y - direction.y * towards.x, glm::dot(direction, towards));
    const double most = std::min(kHelpBend * since_pop_ / kHelpAfter, 3.0 * kHelpBend);
    return turned(direction, std::clamp(angle, -most, most));
}

/// The impact that the ball is in shall leave it with this velocity; or it has it already.
void Game::steer(Ball& ball, const Vec3& velocity) {
    ball.planned = velocity;
    const elastoon::Phase& phase = world_->phase(ball.body);
    const auto* impact = phase.as<Impact>();
    if (impact == nullptr) {
        if (glm::length(world_->velocity(ball.body) - velocity) > kSameSpeed && phase.is<Flight>()) {
            (void)world_->setVelocity(ball.body, velocity);
        }
        return;
    }
    const Vec3 point = impact->surface.pointAt(world_->time());
    const Vec3 normal = impact->surface.normalAt(world_->time());
    const Vec3 carried = impact->surface.frame.velocityAt(world_->time(), point);
    const double parting = glm::dot(velocity - carried, normal);
    if (parting < kLeastParting) {
        ball.planned += flat(normal) * (kLeastParting - parting);
    }
    // An edge that is only grazed has no face to skip along: to roll over it would take the ball around it.
    const double share = -glm::dot(impact->velocity_in, impact->surface.normal) / glm::length(impact->velocity_in);
    const bool skips = impact->skims != Vec3(0.0);
    if (!skips && share < (phase.obstacle == paddle_.obstacle ? kGrazesPaddle : kGrazes)) {
        setFree(ball, ball.planned);
        return;
    }
    (void)world_->steerImpact(ball.body, ball.planned);
}

/// The paddle has changed its velocity, or leans otherwise: what it throws back goes where it was to go.
void Game::holdCourse() {
    for (Ball& ball : balls_) {
        const elastoon::Phase& phase = world_->phase(ball.body);
        if (phase.is<Impact>() && phase.obstacle == paddle_.obstacle) {
            steer(ball, ball.planned);
        }
    }
}

/// Lets the ball fly out of what holds it, from the nearest place where a ball that flies has room.
void Game::setFree(Ball& ball, const Vec3& velocity) {
    constexpr std::array<double, 11> kAside{0.0, 0.02, 0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.8, 1.1, 1.5}; // m
    constexpr int kWays = 8;
    ball.planned = velocity;
    (void)world_->setVelocity(ball.body, velocity);
    const Vec3 position = flat(world_->pose(ball.body).position);
    const Vec3 ahead = unit(velocity, {0.0, 1.0, 0.0});
    for (const double aside : kAside) {
        for (int k = 0; k < (aside > 0.0 ? kWays : 1); ++k) {
            const Vec3 way = turned(ahead, k * 2.0 * elastoon::kPi / kWays);
            if (world_->setPosition(ball.body, position + way * aside)) {
                return;
            }
        }
    }
    ball.crushed = true;
}

/// In flight it has the speed of its height; nothing lets it lie or slide.
void Game::keepGoing(Ball& ball) {
    const elastoon::Phase& phase = world_->phase(ball.body);
    if (phase.is<Impact>()) {
        return;
    }
    const elastoon::Pose pose = world_->pose(ball.body);
    const Vec3 velocity = world_->velocity(ball.body);
    if (!phase.is<Flight>()) {
        Vec3 away(0.0);
        for (const elastoon::KeptClear& kept : phase.clear_of) {
            away += flat(kept.surface.normalAt(world_->time()));
        }
        if (const auto* rest = phase.as<elastoon::Rest>()) {
            away += flat(rest->surface.normalAt(world_->time()));
        }
        const Vec3 way = unit(away, unit(flat(velocity), {0.0, 1.0, 0.0}));
        setFree(ball, steepEnough(way) * speedAt(ball, pose.position.y));
        return;
    }
    const double speed = glm::length(velocity);
    const double wanted = speedAt(ball, pose.position.y);
    constexpr double kMostOff = 1.6;
    const bool off_plane = std::fabs(velocity.z) > 1e-6 || std::fabs(pose.position.z) > 1e-3;
    if (speed > kMostOff * wanted || speed < kStuckSpeed * wanted || off_plane) {
        ball.planned = unit(flat(velocity), {0.0, 1.0, 0.0}) * wanted;
        if (std::fabs(pose.position.z) > 1e-3) {
            (void)world_->setPosition(ball.body, flat(pose.position));
        }
        (void)world_->setVelocity(ball.body, ball.planned);
    }
}

void Game::loseBalls() {
    constexpr double kOutside = 0.5;
    for (std::size_t i = 0; i < balls_.size();) {
        const Vec3 position = world_->pose(balls_[i].body).position;
        const bool outside = std::fabs(position.x) > kHalfWidth + kOutside || position.y > kCeiling + kOutside;
        if (position.y >= kLostBelow && !outside && !balls_[i].crushed) {
            ++i;
            continue;
        }
        escapes_ += outside ? 1 : 0;
        const Vec3 velocity = world_->velocity(balls_[i].body);
        note({.kind = GameEventKind::BallLost,
              .id = balls_[i].id,
              .x = position.x,
              .y = position.y,
              .normal_x = velocity.x,
              .normal_y = velocity.y});
        world_->removeBody(balls_[i].body);
        balls_.erase(balls_.begin() + static_cast<std::ptrdiff_t>(i));
    }
    if (stage_ != Stage::Playing || !balls_.empty() || !waiting_balls_.empty() || blocksLeft() == 0) {
        return;
    }
    --lives_;
    paddle_.wide_left = 0.0;
    speed_up_ = 1.0;
    combo_ = 0;
    since_stage_ = 0.0;
    stage_ = lives_ > 0 ? Stage::Ready : Stage::Lost;
    note({.kind = GameEventKind::LifeLost, .x = paddle_.x, .y = kPaddleFoot, .value = lives_});
    if (stage_ == Stage::Lost) {
        note({.kind = GameEventKind::GameLost, .value = score_});
    }
}

} // namespace squashout
