// Bodies do not notice what they do not meet: other bodies, obstacles out of reach, and the order in which all were
// added and removed. To the bit.
#include "elastoon/world.h"

#include "test_support.h"

#include <algorithm>
#include <vector>

namespace elastoon {
namespace {

constexpr int kBodies = 6;
constexpr double kStep = 1.0 / 60.0;

/// What is looked at: bodies in a room with moving things, from one seed.
struct Room {
    std::vector<BodyDef> bodies;
    std::vector<ObstacleDef> obstacles;
};

ShapePtr anyShape(Random& random) {
    switch (random.below(4)) {
    case 0:
        return valueOf(Shape::sphere(random.uniform(0.2, 0.5)));
    case 1:
        return valueOf(Shape::cylinder(random.uniform(0.2, 0.4), random.uniform(0.3, 1.4)));
    case 2:
        return valueOf(Shape::cone(random.uniform(0.2, 0.4), random.uniform(0.4, 1.0)));
    default:
        return valueOf(Shape::box({random.uniform(0.3, 1.0), random.uniform(0.3, 1.0), random.uniform(0.3, 1.0)}));
    }
}

BodyDef anyBody(Random& random, const Vec3& place) {
    BodyDef def;
    def.shape = anyShape(random);
    def.style.restitution = random.uniform(0.3, 0.95);
    def.style.max_stretch = random.uniform(1.2, 2.2);
    def.style.min_squash = random.uniform(0.35, 0.8);
    def.style.corner_rule = random.below(2) == 0 ? CornerRule::Queued : CornerRule::Blended;
    def.position = place;
    def.velocity = random.inBox(4.0);
    return def;
}

ObstacleDef anyMovingSolid(Random& random, const Vec3& place) {
    ObstacleDef def;
    def.shape = anyShape(random);
    def.position = place;
    def.rotation = random.rotation();
    def.velocity = random.inBox(0.2);
    def.angular_velocity = random.inBox(3.0);
    return def;
}

/// Goes away and comes back, again and again.
ObstacleDef anyPathSolid(Random& random, const Vec3& place) {
    ObstacleDef def = anyMovingSolid(random, place);
    const double half = random.uniform(0.2, 0.9);
    def.path = {{half, place + random.inBox(0.8), random.rotation()}, {2.0 * half, place, def.rotation}};
    def.path_repeats = true;
    return def;
}

Room anyRoom(Random& random, bool standing = false) {
    Room room;
    for (const Vec3 normal : {Vec3(0, 1, 0), Vec3(1, 0.1, 0), Vec3(-1, 0, 0.1), Vec3(0, 0.1, 1), Vec3(0, 0, -1)}) {
        room.obstacles.push_back(ObstacleDef::plane(normal, normal.y == 1.0 ? 0.0 : -6.0));
    }
    for (int i = 0; i < 4; ++i) {
        const Vec3 place(random.uniform(-4, 4), random.uniform(0.5, 2.0), random.uniform(-4, 4));
        room.obstacles.push_back(i % 2 == 0 ? anyMovingSolid(random, place) : anyPathSolid(random, place));
        if (standing) {
            ObstacleDef& def = room.obstacles.back();
            def.velocity = def.angular_velocity = Vec3(0.0);
            def.path.clear();
        }
    }
    for (int i = 0; i < kBodies; ++i) {
        room.bodies.push_back(anyBody(random, {1.5 * i - 4.0, 4.5 + 0.3 * i, random.uniform(-3, 3)}));
    }
    return room;
}

/// A place that no body of the room comes near to.
Vec3 faraway(Random& random) {
    return Vec3(random.below(2) == 0 ? 500.0 : -500.0, 400.0, 0.0) + random.inBox(30.0);
}

/// A world with the room in it, in an order of its own, and with as much as one likes beside it.
class Told {
public:
    Told(const Room& room, Random* noise) : noise_(noise) {
        std::vector<std::size_t> order;
        for (std::size_t i = 0; i < room.bodies.size(); ++i) {
            order.push_back(i);
        }
        if (noise_ != nullptr) {
            for (std::size_t i = order.size(); i > 1; --i) {
                std::swap(order[i - 1], order[static_cast<std::size_t>(noise_->below(static_cast<int>(i)))]);
            }
        }
        for (const ObstacleDef& obstacle : room.obstacles) {
            disturb();
            (void)valueOf(world_.addObstacle(obstacle));
        }
        bodies_.resize(room.bodies.size());
        for (const std::size_t i : order) {
            disturb();
            bodies_[i] = valueOf(world_.addBody(room.bodies[i]));
        }
    }
    void step() {
        disturb();
        world_.step(kStep);
    }
    [[nodiscard]] const World& world() const { return world_; }
    [[nodiscard]] BodyId body(std::size_t index) const { return bodies_[index]; }
    [[nodiscard]] int disturbances() const { return disturbances_; }

private:
    /// Adds, removes and moves what the room does not meet.
    void disturb() {
        for (int count = noise_ == nullptr ? 0 : noise_->below(4); count > 0; --count) {
            disturbOnce(*noise_);
            ++disturbances_;
        }
    }
    void disturbOnce(Random& random) {
        const int what = random.below(8);
        if (what < 2) {
            // Bodies meet no bodies: these may fly through the room.
            const Vec3 place = random.below(2) == 0 ? faraway(random) : Vec3(0, 5, 0) + random.inBox(1.0);
            if (auto added = world_.addBody(anyBody(random, place))) {
                other_bodies_.push_back(added.value());
            }
        } else if (what < 4) {
            const Vec3 place = faraway(random);
            other_obstacles_.push_back(valueOf(world_.addObstacle(
                random.below(2) == 0 ? anyMovingSolid(random, place)
                                     : ObstacleDef::plane(random.direction() + Vec3(0, 1.5, 0), -5000.0))));
        } else if (what == 4 && !other_bodies_.empty()) {
            EXPECT_TRUE(world_.removeBody(taken(other_bodies_, random)));
        } else if (what == 5 && !other_obstacles_.empty()) {
            EXPECT_TRUE(world_.removeObstacle(taken(other_obstacles_, random)));
        } else if (what == 6 && !other_obstacles_.empty()) {
            const ObstacleId id =
                other_obstacles_[static_cast<std::size_t>(random.below(static_cast<int>(other_obstacles_.size())))];
            if (world_.shape(id) != nullptr) {
                EXPECT_TRUE(world_.setObstacleMotion(id, random.inBox(1.0), random.inBox(9.0)).ok());
            }
        } else if (!other_bodies_.empty()) {
            EXPECT_TRUE(world_.setVelocity(other_bodies_.back(), random.inBox(3.0)).ok());
        }
    }
    template <class Id>
    static Id taken(std::vector<Id>& ids, Random& random) {
        const auto at = ids.begin() + random.below(static_cast<int>(ids.size()));
        const Id id = *at;
        ids.erase(at);
        return id;
    }

    World world_ = worldWith();
    Random* noise_;
    std::vector<BodyId> bodies_, other_bodies_;
    std::vector<ObstacleId> other_obstacles_;
    int disturbances_ = 0;
};

/// What two worlds with the same room in them showed, step by step.
struct Seen {
    int first_difference = -1; ///< step after which a body is not the same to the bit; -1: none
    double apart = 0.0;        ///< how far the bodies were from themselves then, m
    int impacts = 0;
};

bool same(const World& a, BodyId of_a, const World& b, BodyId of_b) {
    const Pose first = a.pose(of_a), second = b.pose(of_b);
    return first.position == second.position && first.orientation == second.orientation &&
           first.stretch == second.stretch && a.velocity(of_a) == b.velocity(of_b) &&
           a.phase(of_a).start == b.phase(of_b).start && nameOf(a.phase(of_a)) == nameOf(b.phase(of_b));
}

Seen watch(Told& alone, Told& crowded, int steps) {
    Seen seen;
    for (int step = 0; step < steps && seen.first_difference < 0; ++step) {
        alone.step();
        crowded.step();
        const World &a = alone.world(), &b = crowded.world();
        for (std::size_t i = 0; i < kBodies; ++i) {
            if (!same(a, alone.body(i), b, crowded.body(i))) {
                seen.first_difference = step;
                const Vec3 apart = a.pose(alone.body(i)).position - b.pose(crowded.body(i)).position;
                seen.apart = std::max(seen.apart, glm::length(apart));
            }
        }
        seen.impacts += static_cast<int>(std::count_if(a.events().begin(), a.events().end(),
                                                       [](const Event& e) { return e.type == EventType::Impact; }));
    }
    return seen;
}

TEST(Unrelated, BodiesDoNotNoticeWhatTheyDoNotMeet) {
    int impacts = 0;
    int disturbances = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        Random random(1000 + seed);
        Random noise(2000 + seed);
        const Room room = anyRoom(random, seed % 2 == 1);
        Told alone(room, nullptr);
        Told crowded(room, &noise);
        const Seen seen = watch(alone, crowded, 240);
        EXPECT_EQ(seen.first_difference, -1) << "seed " << seed << ", " << seen.apart << " m";
        impacts += seen.impacts;
        disturbances += crowded.disturbances();
    }
    EXPECT_GT(impacts, 300);
    EXPECT_GT(disturbances, 3000);
}

TEST(Unrelated, TheOrderOfWhatIsUnrelatedDoesNotMatter) {
    Random random(7);
    const Room room = anyRoom(random);
    Random first_noise(8), second_noise(9);
    Told first(room, &first_noise), second(room, &second_noise);
    EXPECT_EQ(watch(first, second, 240).first_difference, -1);
}

TEST(Unrelated, WhatStandsInTheWayIsNoticed) {
    // So that the tests above can fail.
    Random random(11);
    Room room = anyRoom(random);
    Told without(room, nullptr);
    room.obstacles.push_back(ObstacleDef::plane({0, 1, 0.01}, 0.05));
    Told with(room, nullptr);
    EXPECT_GE(watch(without, with, 240).first_difference, 0);
}

TEST(Unrelated, APathElsewhereIsAsASmallerStep) {
    // The keys of a path cut the step in parts, for every body (docs/determinism.md): touches are found as exactly as
    // before, but with other last digits.
    double apart = 0.0;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        Random random(1000 + seed);
        Room room = anyRoom(random);
        Told without(room, nullptr);
        for (int i = 0; i < 30; ++i) {
            room.obstacles.push_back(anyPathSolid(random, faraway(random)));
        }
        Told with(room, nullptr);
        apart = std::max(apart, watch(without, with, 180).apart);
    }
    EXPECT_EQ(apart, 0.0);
}

} // namespace
} // namespace elastoon
