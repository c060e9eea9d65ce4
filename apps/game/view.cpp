// See view.h.
#include "view.h"

#include "dmath.h"

#include <algorithm>

namespace squashout {

namespace {

/// A ball that waits breathes, with its foot on the paddle.
Drawn waitingBall(const Game& game) {
    constexpr double kRate = 5.0, kDepth = 0.06;
    Drawn ball;
    ball.what = DrawnKind::WaitingBall;
    const double stretch = 1.0 - kDepth + kDepth * elastoon::detSinCos(kRate * game.time()).sin;
    const Vec3 scale = elastoon::scaleOf(stretch);
    ball.linear = elastoon::Mat3(0.0);
    ball.linear[0].x = ball.linear[2].z = scale.y;
    ball.linear[1].y = scale.x;
    ball.position = game.waitingBall() - Vec3(0.0, kBallRadius * (1.0 - stretch), 0.0);
    return ball;
}

} // namespace

void View::capture(const Game& game) {
    std::swap(before_, now_);
    now_.clear();
    const double t = game.time();
    const Paddle& paddle = game.paddle();
    Drawn bat;
    bat.what = DrawnKind::Paddle;
    bat.extra = paddle.half_width;
    const elastoon::MovingFrame& frame = game.world().frame(paddle.obstacle);
    bat.linear = glm::mat3_cast(frame.orientationAt(t));
    // From the solid's centroid to its foot, which is where the outline is at home.
    const Vec3 centroid = game.world().shape(paddle.obstacle)->centroidOfInput();
    bat.position = frame.originAt(t) - bat.linear * centroid;
    paddle.response.apply(t, bat.position, bat.linear);
    now_.push_back(bat);
    for (const LiveBlock& block : game.blocks()) {
        Drawn drawn;
        drawn.block = block.kind;
        drawn.id = block.id;
        drawn.extra = block.hits_left;
        drawn.position = {block.x, block.y, 0.0};
        block.response.apply(t, drawn.position, drawn.linear);
        now_.push_back(drawn);
    }
    for (const Ball& ball : game.balls()) {
        const elastoon::Pose pose = game.world().pose(ball.body);
        Drawn drawn;
        drawn.what = DrawnKind::Ball;
        drawn.id = ball.id;
        drawn.extra = game.world().phase(ball.body).is<elastoon::Impact>() ? 1.0 : 0.0;
        drawn.position = pose.position;
        drawn.linear = elastoon::linearOf(pose);
        now_.push_back(drawn);
    }
    if (game.stage() == Stage::Ready) {
        now_.push_back(waitingBall(game));
    }
}

std::vector<Drawn> View::drawn(double share) const {
    std::vector<Drawn> between = now_;
    for (Drawn& drawn : between) {
        const auto found = std::find_if(before_.begin(), before_.end(), [&](const Drawn& old) {
            return old.what == drawn.what && old.id == drawn.id && old.extra == drawn.extra;
        });
        if (found == before_.end()) {
            continue;
        }
        // A ball's axis has two ends: at a forward swap the nearer one counts.
        const double same = drawn.what == DrawnKind::Ball && glm::dot(found->linear[0], drawn.linear[0]) < 0.0 ? -1 : 1;
        drawn.position = found->position * (1.0 - share) + drawn.position * share;
        for (int column = 0; column < 3; ++column) {
            const double sign = column < 2 ? same : 1.0;
            drawn.linear[column] = found->linear[column] * (1.0 - share) * sign + drawn.linear[column] * share;
        }
    }
    return between;
}

} // namespace squashout
