// Blocks: how they are set up, hit, popped, and what comes of it.
#include "game.h"

#include "dmath.h"

#include <algorithm>

namespace squashout {

using elastoon::ObstacleDef;

namespace {

constexpr int kKeysOfWay = 24; ///< there and back, eased as a cosine
constexpr std::uint64_t kStepsToBlast = 7;
constexpr double kStepsForDistance = 4.0; ///< more, for each m

void addWay(ObstacleDef& def, const LevelBlock& block) {
    for (int i = 1; i <= kKeysOfWay; ++i) {
        const double share = static_cast<double>(i) / kKeysOfWay;
        const double along = 0.5 - 0.5 * elastoon::detSinCos(2.0 * elastoon::kPi * share).cos;
        const Vec3 position = i == kKeysOfWay ? def.position : def.position + Vec3(along * block.by, 0.0, 0.0);
        def.path.push_back({.time = share * block.period, .position = position, .rotation = def.rotation});
    }
    def.path_repeats = true;
}

} // namespace

void Game::addBlock(const LevelBlock& block) {
    const KindTraits& traits = traitsOf(block.kind);
    ObstacleDef def;
    def.shape = traits.is_round ? round_shape_ : block_shape_;
    def.position = {block.x, block.y, 0.0};
    if (block.by != 0.0) {
        addWay(def, block);
    }
    LiveBlock live;
    live.id = next_id_++;
    live.kind = block.kind;
    live.hits_left = traits.hits;
    live.obstacle = world_->addObstacle(def).value();
    live.x = block.x;
    live.y = block.y;
    blocks_.push_back(live);
}

LiveBlock* Game::blockOf(ObstacleId id) {
    const auto found =
        std::find_if(blocks_.begin(), blocks_.end(), [&](const LiveBlock& block) { return block.obstacle == id; });
    return found == blocks_.end() ? nullptr : &*found;
}

void Game::burnFuses() {
    for (std::size_t i = 0; i < blocks_.size();) {
        if (blocks_[i].fuse != 0 && steps_ >= blocks_[i].fuse) {
            pop(i); // others take its place
        } else {
            ++i;
        }
    }
}

/// What a ball has broken pops when no ball is in contact with it any more.
void Game::popBlocks() {
    for (std::size_t i = 0; i < blocks_.size();) {
        const bool held = std::any_of(balls_.begin(), balls_.end(), [&](const Ball& ball) {
            const elastoon::Phase& phase = world_->phase(ball.body);
            return phase.is<elastoon::Impact>() && phase.obstacle == blocks_[i].obstacle;
        });
        if (blocks_[i].dying && !held) {
            pop(i);
        } else {
            ++i;
        }
    }
}

void Game::pop(std::size_t index) {
    const LiveBlock block = blocks_[index];
    blocks_.erase(blocks_.begin() + static_cast<std::ptrdiff_t>(index));
    std::vector<std::size_t> in_contact;
    for (std::size_t i = 0; i < balls_.size(); ++i) {
        const elastoon::Phase& phase = world_->phase(balls_[i].body);
        if (!phase.is<elastoon::Flight>() && phase.obstacle == block.obstacle) {
            in_contact.push_back(i);
        }
    }
    world_->removeObstacle(block.obstacle);
    // A blast took it from under a ball: that goes on as it would have.
    for (const std::size_t i : in_contact) {
        setFree(balls_[i], balls_[i].planned);
    }
    combo_ = std::min(combo_ + 1, kMostCombo);
    const int points = traitsOf(block.kind).points * combo_;
    score_ += points;
    since_pop_ = 0.0;
    note({.kind = GameEventKind::Popped,
          .block = block.kind,
          .id = block.id,
          .x = block.x,
          .y = block.y,
          .value = points});
    if (block.kind == BlockKind::Explosive) {
        blast(block);
    }
    reward(block);
}

void Game::blast(const LiveBlock& bomb) {
    note({.kind = GameEventKind::Exploded, .block = bomb.kind, .id = bomb.id, .x = bomb.x, .y = bomb.y});
    for (LiveBlock& block : blocks_) {
        const double distance = glm::length(Vec3(block.x - bomb.x, block.y - bomb.y, 0.0));
        if (distance <= kBlast && traitsOf(block.kind).hits > 0 && block.fuse == 0) {
            block.fuse = steps_ + kStepsToBlast + static_cast<std::uint64_t>(distance * kStepsForDistance);
        }
    }
}

void Game::reward(const LiveBlock& block) {
    switch (block.kind) {
    case BlockKind::Ball:
        waiting_balls_.emplace_back(block.x, block.y, 0.0);
        break;
    case BlockKind::Wide:
        paddle_.wide_left = kWideFor;
        break;
    case BlockKind::Heart:
        lives_ = std::min(lives_ + 1, kMostLives);
        note({.kind = GameEventKind::LifeGained, .id = block.id, .x = block.x, .y = block.y, .value = lives_});
        break;
    default:
        break;
    }
}

} // namespace squashout
