// See bot.h.
#include "bot.h"

#include "dmath.h"

#include <algorithm>
#include <cmath>

namespace squashout {

namespace {

constexpr double kHandSpeed = 15.0; ///< m/s: no quicker than a hand
constexpr double kPaddleTop = kPaddleFoot + kPaddleHeight;
constexpr double kMostTarget = 32767.0;

/// Where a way along x ends between the walls, reflected as often as it takes.
double folded(double x) {
    constexpr double kHalf = kHalfWidth - kBallRadius;
    const double lap = 4.0 * kHalf;
    double along = x + kHalf;
    along -= lap * std::floor(along / lap);
    return along <= 2.0 * kHalf ? along - kHalf : 3.0 * kHalf - along;
}

} // namespace

std::optional<Bot::Landing> Bot::nextLanding(const Game& game) {
    std::optional<Landing> next;
    const double pull = game.def().gravity ? game.level().gravity : 0.0;
    for (const Ball& ball : game.balls()) {
        const Vec3 position = game.world().pose(ball.body).position;
        const bool in_contact = !game.world().phase(ball.body).is<elastoon::Flight>();
        const Vec3 velocity = in_contact ? ball.planned : game.world().velocity(ball.body);
        const double drop = position.y - kPaddleTop - kBallRadius;
        double time = 0.0;
        if (pull > 0.0) {
            time = (velocity.y + std::sqrt(std::max(0.0, velocity.y * velocity.y + 2.0 * pull * drop))) / pull;
        } else if (velocity.y < 0.0) {
            time = drop / -velocity.y;
        } else {
            time = (2.0 * kCeiling - kPaddleTop - position.y) / std::max(velocity.y, 1.0);
        }
        const Landing landing{time, folded(position.x + velocity.x * time), ball.id, velocity.y < 0.0};
        if (time > -0.1 && (!next || landing.time < next->time)) {
            next = landing;
        }
    }
    return next;
}

/// Chooses a block, and where on the paddle the ball must land to go there.
void Bot::aim(const Game& game, const Landing& landing) {
    aimed_ball_ = landing.ball;
    aimed_falling_ = landing.falls;
    std::vector<const LiveBlock*> wanted;
    for (const LiveBlock& block : game.blocks()) {
        if (traitsOf(block.kind).hits > 0) {
            wanted.push_back(&block);
        }
    }
    offset_ = random_.uniform(-0.5, 0.5);
    if (!wanted.empty()) {
        const std::size_t pick = random_.next() % wanted.size();
        const double angle = elastoon::detAtan2(wanted[pick]->x - landing.x, wanted[pick]->y - kPaddleTop);
        offset_ = std::clamp(angle / kSteepestAim, -0.8, 0.8);
    }
    const double spread = 0.15 + 3.2 * (1.0 - skill_);
    error_ = 0.5 * spread * (random_.uniform(-1.0, 1.0) + random_.uniform(-1.0, 1.0));
}

PlayInput Bot::play(const Game& game) {
    PlayInput input;
    input.has_target = true;
    double wanted = game.paddle().x;
    const auto landing = nextLanding(game);
    if (landing) {
        if (landing->ball != aimed_ball_ || landing->falls != aimed_falling_) {
            aim(game, *landing);
        }
        const double half = game.paddle().half_width;
        wanted = landing->x - offset_ * half + error_;
        // While it climbs, what lies above decides where it comes down: go there by and by.
        wanted = landing->falls ? wanted : 0.5 * (wanted + game.paddle().x);
    } else {
        waits_ -= kStep;
        if (waits_ <= 0.0) {
            input.launch = true;
            waits_ = random_.uniform(0.4, 1.0);
        }
    }
    hand_ += std::clamp(wanted - hand_, -kHandSpeed * kStep, kHandSpeed * kStep);
    hand_ = std::clamp(hand_, -kHalfWidth, kHalfWidth);
    input.target = static_cast<std::int16_t>(std::floor(hand_ / kHalfWidth * kMostTarget));
    return input;
}

} // namespace squashout
