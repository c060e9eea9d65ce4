// Rooms full of bodies and obstacles, some of which move, come and go: long runs, watched by the oracle's arithmetic.
// ELASTOON_SOAK=50 makes them 200 rooms of a minute each, at 30 and at 144 steps a second.
#include "closest.h"
#include "closest_support.h"
#include "witness_support.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace elastoon {
namespace {

constexpr int kBodies = 20;
constexpr int kStanding = 18;
constexpr int kMoving = 6;
constexpr Vec3 kRoom{12.0, 8.0, 12.0}; ///< half sizes, m
constexpr double kMostDepth = 1e-5; ///< of the body's length
constexpr double kMostJump = 1e-6;

struct Thing {
    ObstacleId id;
    ObstacleDef def;
    double added = 0.0;
    double ball = 0.0; ///< about the position: all that it covers as it moves
};

struct Tally {
    long steps = 0, phases = 0, impacts = 0, rests = 0, squeezes = 0, changes = 0;
    long near = 0, certified = 0; ///< pairs in reach; of those, parted by a plane
    double depth = 0.0, jump = 0.0, over_stretched = 0.0, gained = 0.0, lifted = 0.0;
    std::string where;
};

std::vector<ShapePtr> castOfBodies() {
    return {valueOf(Shape::box({0.3, 1.0, 0.5})),  valueOf(Shape::cylinder(0.4, 0.8, 16)),
            valueOf(Shape::cylinder(0.2, 1.2, 8)), valueOf(Shape::cone(0.5, 1.0, 12)),
            valueOf(Shape::sphere(0.4, 2)),        valueOf(Shape::sphere(0.5, 4)),
            valueOf(Shape::box({0.8, 0.05, 0.8})), valueOf(Shape::box({1.2, 0.04, 0.04})),
            valueOf(Shape::capsule(0.2, 1.1, 8)),  valueOf(Shape::box({0.6, 0.6, 0.6}))};
}

std::vector<ShapePtr> castOfSolids() {
    return {valueOf(Shape::box({3.0, 1.0, 3.0})),   valueOf(Shape::box({0.1, 2.0, 3.0})),
            valueOf(Shape::cylinder(0.6, 2.5, 12)), valueOf(Shape::cone(1.2, 1.5, 12)),
            valueOf(Shape::sphere(1.1, 2)),         valueOf(Shape::box({3.0, 0.2, 0.2}))};
}

/// One room, its bodies, and the user who changes it.
class Crowd {
public:
    Crowd(int index, double fps, Tally& tally);
    void run(double seconds);

private:
    void addPlanes();
    void addStanding();
    void addMoving();
    void addBodies();
    void change();
    void replaceOne();
    void throwOne();
    [[nodiscard]] bool isClear(const Vec3& center, double ball) const;
    void look();
    void lookAtPhases();
    void lookAtPose(BodyId body, const Pose& pose, double t);
    void lookAtPair(const Shape& shape, const Pose& pose, const Thing& thing, double t);
    [[nodiscard]] double heightOf(const Flight& flight) const;
    void lookAtEnergy(BodyId body, const Phase& before, const Phase& after);
    void note(double Tally::* worst, double value, BodyId body, const Phase& phase, double t);

    int index_;
    double fps_;
    Random random_;
    Tally& tally_;
    World world_;
    bool standing_; ///< nothing in it moves or changes
    std::vector<ShapePtr> shapes_ = castOfBodies();
    std::vector<ShapePtr> solids_ = castOfSolids();
    std::vector<Thing> things_;
    std::vector<BodyId> bodies_;
    std::map<std::uint32_t, Phase> last_; ///< by slot
    std::map<std::uint32_t, double> squeezed_; ///< when, by slot
    std::map<std::uint32_t, double> heights_;  ///< of the last flight, by slot
    std::uint32_t touched_by_user_ = 0;
    BodyId looked_at_;
};

Crowd::Crowd(int index, double fps, Tally& tally)
    : index_(index),
      fps_(fps),
      random_(7000 + static_cast<std::uint64_t>(index)),
      tally_(tally),
      world_(worldWith(index % 4 == 0
                           ? Vec3(0.0)
                           : random_.uniform(3.0, 12.0) * glm::normalize(Vec3(0, -1, 0) + random_.inBox(0.2)))),
      standing_(index % 4 == 1) {
    addPlanes();
    addStanding();
    if (!standing_) {
        addMoving();
    }
    addBodies();
}

void Crowd::addPlanes() {
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            Vec3 normal(0.0);
            normal[axis] = -side;
            if (random_.below(2) == 0) {
                normal = glm::normalize(normal + random_.inBox(0.2));
            }
            Thing plane;
            plane.def.normal = normal;
            plane.def.position[axis] = side * kRoom[axis];
            plane.id = valueOf(world_.addObstacle(plane.def));
            things_.push_back(plane);
        }
    }
}

void Crowd::addStanding() {
    for (int i = 0; i < kStanding; ++i) {
        Thing solid;
        solid.def.shape = anyOf(random_, solids_);
        solid.def.position = kRoom * random_.inBox(0.8);
        solid.def.rotation = random_.below(3) == 0 ? kNoRotation : random_.rotation();
        solid.ball = solid.def.shape->boundingRadius();
        solid.id = valueOf(world_.addObstacle(solid.def));
        things_.push_back(solid);
    }
}

/// They leave room for a flattened body between them and all else: a press without any is another test.
void Crowd::addMoving() {
    for (int i = 0; i < kMoving; ++i) {
        Thing solid;
        solid.def.shape = anyOf(random_, solids_);
        const double radius = solid.def.shape->boundingRadius();
        const double way = random_.below(3) == 0 ? 0.0 : random_.uniform(0.5, 2.0);
        solid.ball = radius + way;
        for (int tries = 0; tries < 200; ++tries) {
            solid.def.position = kRoom * random_.inBox(0.8);
            if (isClear(solid.def.position, solid.ball + 1.0)) {
                solid.def.rotation = random_.rotation();
                const double time = random_.uniform(1.0, 4.0);
                if (way > 0.0) {
                    solid.def.path = {{time, solid.def.position + way * random_.direction(),
                                       random_.below(2) == 0 ? random_.rotation() : solid.def.rotation},
                                      {2.0 * time, solid.def.position, solid.def.rotation}};
                    solid.def.path_repeats = true;
                } else {
                    solid.def.angular_velocity = random_.inBox(1.0);
                }
                solid.added = world_.time();
                solid.id = valueOf(world_.addObstacle(solid.def));
                things_.push_back(solid);
                break;
            }
        }
    }
}

void Crowd::addBodies() {
    while (bodies_.size() < kBodies) {
        BodyDef def;
        def.shape = shapes_[bodies_.size() % shapes_.size()];
        def.style = anyStyle(random_);
        def.style.corner_rule = random_.below(3) == 0 ? CornerRule::Blended : CornerRule::Queued;
        def.position = kRoom * random_.inBox(0.8);
        def.velocity = random_.inBox(random_.uniform(0.0, 10.0));
        def.rotation = random_.rotation();
        if (!world_.overlapOf(def)) {
            bodies_.push_back(valueOf(world_.addBody(def)));
        }
    }
    for (const BodyId body : bodies_) {
        last_[body.slot] = world_.phase(body);
    }
}

/// No obstacle and no body is within the ball.
bool Crowd::isClear(const Vec3& center, double ball) const {
    const bool clear_of_things = std::all_of(things_.begin(), things_.end(), [&](const Thing& thing) {
        return thing.def.shape ? glm::length(thing.def.position - center) > thing.ball + ball
                               : glm::dot(center - thing.def.position, thing.def.normal) > ball;
    });
    return clear_of_things && std::all_of(bodies_.begin(), bodies_.end(), [&](BodyId body) {
               const double reach = world_.shape(body)->boundingRadius() * world_.style(body).max_stretch * 1.5;
               return glm::length(world_.pose(body).position - center) > ball + reach;
           });
}

void Crowd::change() {
    touched_by_user_ = 0;
    constexpr double kChangesPerSecond = 2.0;
    if (standing_ || random_.uniform(0.0, 1.0) > kChangesPerSecond / fps_) {
        return;
    }
    ++tally_.changes;
    random_.below(4) == 0 ? replaceOne() : throwOne();
}

/// A solid that stands goes, and another comes: under a body that lies on it, or against which it squashes, too.
void Crowd::replaceOne() {
    const auto i = std::size_t{6} + static_cast<std::size_t>(random_.below(kStanding));
    Thing next;
    next.def.shape = anyOf(random_, solids_);
    next.ball = next.def.shape->boundingRadius();
    next.def.position = kRoom * random_.inBox(0.8);
    next.def.rotation = random_.rotation();
    if (!isClear(next.def.position, next.ball)) {
        return;
    }
    if (random_.below(2) == 0 && things_[i].def.shape == next.def.shape) {
        ASSERT_TRUE(world_.setObstaclePose(things_[i].id, next.def.position, next.def.rotation));
        next.id = things_[i].id;
    } else {
        ASSERT_TRUE(world_.removeObstacle(things_[i].id));
        next.id = valueOf(world_.addObstacle(next.def));
    }
    next.added = world_.time();
    things_[i] = next;
}

void Crowd::throwOne() {
    const BodyId body = bodies_[static_cast<std::size_t>(random_.below(kBodies))];
    touched_by_user_ = body.slot;
    if (random_.below(2) == 0) {
        (void)world_.setVelocity(body, random_.inBox(10.0));
    } else {
        (void)world_.setPosition(body, kRoom * random_.inBox(0.7));
    }
}

void Crowd::note(double Tally::* worst, double value, BodyId body, const Phase& phase, double t) {
    if (value > tally_.*worst) {
        tally_.*worst = value;
        char text[200];
        std::snprintf(text, sizeof text, "room %d at %g fps, body %u, %s, t %.9f", index_, fps_, body.slot,
                      std::string(nameOf(phase)).c_str(), t);
        const double most = worst == &Tally::depth    ? kMostDepth
                            : worst == &Tally::jump   ? kMostJump
                            : worst == &Tally::lifted ? 2.0
                                                      : 1e-6;
        if (value > most) {
            tally_.where += std::string("\n") + text + ": " + std::to_string(value);
        }
    }
}

void Crowd::lookAtPair(const Shape& shape, const Pose& pose, const Thing& thing, double t) {
    const MovingFrame frame = frameAt(thing.def, thing.added, t);
    const Vec3 origin = frame.originAt(t);
    const Quat turned = frame.orientationAt(t);
    double gap = std::numeric_limits<double>::infinity();
    if (!thing.def.shape) {
        const Vec3 normal = turned * glm::normalize(thing.def.normal);
        for (const Vec3& vertex : shape.vertices()) {
            gap = std::min(gap, glm::dot(worldFromShape(pose, vertex) - origin, normal));
        }
    } else {
        const double reach = glm::length(pose.position - origin) - thing.def.shape->boundingRadius();
        if (reach > shape.boundingRadius() * std::max(pose.stretch, 1.0 / std::sqrt(pose.stretch))) {
            return;
        }
        ++tally_.near;
        // A plane that parts the two is proof, whoever found it.
        ClosestSeed cold;
        const Closest closest = closestPoints({&shape, linearOf(pose), pose.position},
                                              {thing.def.shape.get(), glm::mat3_cast(turned), origin}, cold);
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (const Vec3& vertex : shape.vertices()) {
            low = std::min(low, glm::dot(worldFromShape(pose, vertex), closest.normal));
        }
        for (const Vec3& vertex : thing.def.shape->vertices()) {
            high = std::max(high, glm::dot(origin + turned * vertex, closest.normal));
        }
        gap = low - high;
        if (!closest.overlap && gap > -0.1 * kMostDepth * shape.length()) {
            ++tally_.certified;
            return;
        }
        gap = shape.length() * separation(shape, pose, *thing.def.shape, {origin, turned, 1.0});
    }
    note(&Tally::depth, -gap / shape.length(), looked_at_, world_.phase(looked_at_), t);
}

void Crowd::lookAtPose(BodyId body, const Pose& pose, double t) {
    ASSERT_TRUE(std::isfinite(glm::dot(pose.position, pose.position) + pose.stretch + pose.orientation.w));
    looked_at_ = body;
    for (const Thing& thing : things_) {
        lookAtPair(*world_.shape(body), pose, thing, t);
    }
    const Style& style = world_.style(body);
    const std::vector<KeptClear> clear_of = world_.phase(body).clear_of;
    for (const KeptClear& kept : clear_of) {
        if (kept.presses) {
            squeezed_[body.slot] = t;
        }
    }
    // What came to rest squeezed stays so.
    const Phase& phase = world_.phase(body);
    const double formed = phase.is<Rest>() ? std::min(t, phase.start) : t;
    const auto squeezed = squeezed_.find(body.slot);
    if (squeezed == squeezed_.end() || formed > squeezed->second + 3.0) {
        const double over = std::max(pose.stretch / style.max_stretch, style.min_squash / pose.stretch) - 1.0;
        note(&Tally::over_stretched, over, body, world_.phase(body), t);
    }
}

/// How high the centroid would come if the flight went straight up, m.
double Crowd::heightOf(const Flight& flight) const {
    const double pull = glm::length(world_.gravity());
    return (0.5 * glm::dot(flight.velocity, flight.velocity) - glm::dot(world_.gravity(), flight.position)) / pull;
}

/// An impact of a standing room speeds nothing up, apart from the push off what cannot hold; and no flight can come
/// higher than the one before by more than twice the stretched body's size: a turn may lift it by one, and a corner
/// pushes it.
void Crowd::lookAtEnergy(BodyId body, const Phase& before, const Phase& after) {
    const auto* impact = before.as<Impact>();
    const auto* flight = after.as<Flight>();
    if (standing_ && flight != nullptr) {
        const double height = heightOf(*flight);
        const double size = 2.0 * world_.shape(body)->boundingRadius() * world_.style(body).max_stretch;
        const auto [last, first] = heights_.try_emplace(body.slot, height);
        note(&Tally::lifted, (height - last->second) / size, body, after, after.start);
        last->second = height;
    }
    if (!standing_ || impact == nullptr || flight == nullptr) {
        return;
    }
    const Style& style = world_.style(body);
    const double rest = restSpeed(style, world_.shape(body)->length(), glm::length(world_.gravity()));
    const double in = glm::length(impact->velocity_in);
    note(&Tally::gained, glm::length(flight->velocity) - std::sqrt(in * in + 2.0 * rest * rest), body, after,
         after.start);
}

void Crowd::lookAtPhases() {
    for (const PhaseBegun& begun : world_.phasesBegun()) {
        Phase& last = last_[begun.body.slot];
        const Shape& shape = *world_.shape(begun.body);
        const double t = begun.phase.start;
        const Pose after = poseAt(begun.phase, shape, t);
        if (begun.body.slot != touched_by_user_) {
            const Pose before = poseAt(last, shape, t);
            note(&Tally::jump,
                 std::max({glm::length(before.position - after.position) / shape.length(),
                           std::fabs(before.stretch - after.stretch),
                           angleBetween(before.orientation, after.orientation)}),
                 begun.body, begun.phase, t);
            lookAtEnergy(begun.body, last, begun.phase);
        }
        lookAtPose(begun.body, after, t);
        ++tally_.phases;
        last = begun.phase;
    }
}

void Crowd::look() {
    for (const Event& event : world_.events()) {
        tally_.impacts += event.type == EventType::Impact ? 1 : 0;
        tally_.rests += event.type == EventType::Rest ? 1 : 0;
        if (event.type == EventType::Squeeze) {
            ++tally_.squeezes;
            squeezed_[event.body.slot] = event.time;
        }
    }
    lookAtPhases();
    const long step = std::lround(world_.time() * fps_);
    for (const BodyId body : bodies_) {
        ++tally_.steps;
        const Phase& phase = world_.phase(body);
        const auto* rest = phase.as<Rest>();
        const bool all_still = rest != nullptr && !rest->surface.frame.moves() && standing_;
        if (!all_still && (rest == nullptr || step % 8 == 0)) {
            lookAtPose(body, world_.pose(body), world_.time());
        }
    }
}

void Crowd::run(double seconds) {
    for (long k = 0; k < std::lround(seconds * fps_); ++k) {
        change();
        world_.step(1.0 / fps_);
        ASSERT_NO_FATAL_FAILURE(look());
    }
}

TEST(Crowd, RoomsThatChangeHoldTheirBounds) {
    Tally tally;
    const int rooms = 4 * soak();
    const double seconds = soak() > 1 ? 60.0 : 4.0;
    for (int i = 0; i < rooms; ++i) {
        for (const double fps : {30.0, 144.0}) {
            Crowd crowd(i, fps, tally);
            ASSERT_NO_FATAL_FAILURE(crowd.run(seconds));
        }
        if (soak() > 1 && i % 10 == 9) {
            std::printf("crowd: %d rooms, depth %.2g L, jump %.2g\n", i + 1, tally.depth, tally.jump);
            std::fflush(stdout);
        }
    }
    EXPECT_LE(tally.depth, kMostDepth) << tally.where;
    EXPECT_LE(tally.jump, kMostJump) << tally.where;
    EXPECT_LE(tally.over_stretched, 1e-9) << tally.where;
    EXPECT_LE(tally.gained, 1e-9) << tally.where;
    EXPECT_LE(tally.lifted, 2.0) << tally.where;
    EXPECT_GT(tally.impacts, 20 * rooms);
    EXPECT_GT(tally.rests, 0);
    EXPECT_GT(tally.changes, rooms);
    EXPECT_GT(tally.certified, tally.near / 2) << "the slow oracle is for the rest";
    if (soak() > 1) {
        std::printf("crowd: %ld body-steps, %ld phases, %ld impacts, %ld rests, %ld squeezes, %ld changes; deepest "
                    "%.2g L, jump %.2g, beyond the stretches %.2g, speed gained %.2g m/s, lifted %.2g sizes\n",
                    tally.steps, tally.phases, tally.impacts, tally.rests, tally.squeezes, tally.changes, tally.depth,
                    tally.jump, tally.over_stretched, tally.gained, tally.lifted);
    }
}

} // namespace
} // namespace elastoon
