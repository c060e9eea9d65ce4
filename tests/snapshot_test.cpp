// Snapshots: exact where they are taken back, harmless where they are damaged.
#include "byte_stream.h"
#include "elastoon/scene.h"
#include "snapshot_support.h"

#include <filesystem>
#include <set>

namespace elastoon {
namespace {

using Bytes = std::vector<std::byte>;

bool sameEvents(const World& a, const World& b) {
    const auto same = [](const Event& x, const Event& y) {
        return x.time == y.time && x.type == y.type && x.body == y.body && x.other == y.other && x.point == y.point &&
               x.normal == y.normal && x.speed == y.speed && x.t_in == y.t_in && x.t_out == y.t_out;
    };
    const auto same_phase = [](const PhaseBegun& x, const PhaseBegun& y) {
        return x.body == y.body && x.phase.start == y.phase.start && x.phase.end == y.phase.end &&
               x.phase.obstacle == y.phase.obstacle && x.phase.motion.index() == y.phase.motion.index() &&
               x.phase.clear_of.size() == y.phase.clear_of.size();
    };
    return std::equal(a.events().begin(), a.events().end(), b.events().begin(), b.events().end(), same) &&
           std::equal(a.phasesBegun().begin(), a.phasesBegun().end(), b.phasesBegun().begin(), b.phasesBegun().end(),
                      same_phase);
}

/// A world of its own from these bytes, which hold their shapes.
World worldFrom(const Bytes& bytes) {
    World world = worldWith(Vec3(0.0));
    const Status status = world.restore(bytes);
    EXPECT_TRUE(status.ok()) << (status ? "" : status.error().text());
    return world;
}

void expectSameSteps(World& a, World& b, int steps, double dt) {
    for (int i = 0; i < steps; ++i) {
        a.step(dt);
        b.step(dt);
        ASSERT_EQ(a.stateHash(), b.stateHash()) << "after " << i + 1 << " steps";
        ASSERT_TRUE(sameEvents(a, b)) << "after " << i + 1 << " steps";
    }
    // Bytes hold what the hash does not: seeds, ids, obstacles, user data.
    EXPECT_EQ(a.snapshot(), b.snapshot());
}

std::vector<std::string> sceneFiles() {
    std::vector<std::string> files{ELASTOON_SOURCE_DIR "/scenes/tests/mixed.json"};
    for (const char* folder : {"/scenes/contacts", "/scenes/figures"}) {
        for (const auto& entry : std::filesystem::directory_iterator(ELASTOON_SOURCE_DIR + std::string(folder))) {
            if (entry.is_regular_file()) { // figure 8 is a folder: a recorded play
                files.push_back(entry.path().string());
            }
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

TEST(Snapshot, ScenesGoOnToTheBitFromEveryFewSteps) {
    std::set<std::size_t> phases;
    for (const std::string& file : sceneFiles()) {
        const Scene scene = valueOf(readScene(file));
        StagedScene straight = valueOf(stage(scene));
        std::vector<std::uint64_t> hashes;
        std::vector<Bytes> snapshots;
        const int steps = std::min(240, static_cast<int>(scene.duration * 60.0));
        for (int i = 0; i < steps; ++i) {
            snapshots.push_back(straight.world.snapshot({.include_shapes = true}));
            hashes.push_back(straight.world.stateHash());
            for (const BodyId body : straight.bodies) {
                phases.insert(straight.world.phase(body).motion.index());
            }
            straight.world.step(1.0 / 60.0);
        }
        for (int from = 0; from < steps; from += 7) {
            World world = worldFrom(snapshots[static_cast<std::size_t>(from)]);
            for (int i = from; i < std::min(steps, from + 30); ++i) {
                ASSERT_EQ(world.stateHash(), hashes[static_cast<std::size_t>(i)]) << file << " from " << from;
                ASSERT_EQ(world.snapshot({.include_shapes = true}), snapshots[static_cast<std::size_t>(i)])
                    << file << " from " << from << " at " << i;
                world.step(1.0 / 60.0);
            }
        }
    }
    EXPECT_EQ(phases.size(), 4U) << "the scenes are to show every phase";
}

TEST(Snapshot, BusyRoomsGoOnToTheBit) {
    std::size_t reused = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        World world = worldWith();
        BusyRoom room(seed);
        room.furnish(world, world);
        for (int i = 0; i < 90; ++i) {
            room.change(world, world);
            // Between a user's change and the step, with happenings that wait.
            if (i % 9 == 0) {
                World other = worldFrom(world.snapshot({.include_shapes = true}));
                World same = worldFrom(world.snapshot({.include_shapes = true}));
                ASSERT_NO_FATAL_FAILURE(expectSameSteps(same, other, 20, 1.0 / 60.0)) << "seed " << seed;
                BusyRoom one(seed + 1000);
                BusyRoom two(seed + 1000);
                for (int k = 0; k < 40; ++k) {
                    one.change(same, same);
                    two.change(other, other);
                    same.step(1.0 / 60.0);
                    other.step(1.0 / 60.0);
                }
                ASSERT_EQ(same.bodies(), other.bodies());
                ASSERT_EQ(same.snapshot(), other.snapshot());
            }
            world.step(1.0 / 60.0);
        }
        for (const BodyId body : world.bodies()) {
            reused += body.generation > 1 ? 1U : 0U;
        }
    }
    EXPECT_GT(reused, 0U);
}

TEST(Snapshot, TenThousandStepsLaterNothingDiffers) {
    World world = worldWith();
    BusyRoom room(11);
    room.furnish(world, world);
    for (int i = 0; i < 50; ++i) {
        room.change(world, world);
        world.step(1.0 / 60.0);
    }
    World other = worldFrom(world.snapshot({.include_shapes = true}));
    ASSERT_NO_FATAL_FAILURE(expectSameSteps(world, other, 10000, 1.0 / 120.0));
}

TEST(Snapshot, TakesTheSameWorldBackOverAnythingThatHappened) {
    for (std::uint64_t seed = 21; seed < 25; ++seed) {
        World world = worldWith();
        BusyRoom room(seed);
        room.furnish(world, world);
        for (int i = 0; i < 30; ++i) {
            room.change(world, world);
            world.step(1.0 / 60.0);
        }
        const Bytes before = world.snapshot();
        const auto bodies = world.bodies();
        const auto obstacles = world.obstacles();
        const std::uint64_t user_data = world.userData(bodies.front());
        World other = worldFrom(world.snapshot({.include_shapes = true}));
        for (int i = 0; i < 120; ++i) {
            room.change(world, world);
            world.step(1.0 / 50.0);
        }
        for (const ObstacleId id : world.obstacles()) {
            world.removeObstacle(id);
        }
        world.removeBody(world.bodies().front());
        ASSERT_TRUE(world.restore(before).ok());
        EXPECT_EQ(world.snapshot(), before);
        EXPECT_EQ(world.bodies(), bodies);
        EXPECT_EQ(world.obstacles(), obstacles);
        EXPECT_EQ(world.userData(bodies.front()), user_data);
        EXPECT_TRUE(world.events().empty());
        EXPECT_TRUE(world.phasesBegun().empty());
        ASSERT_NO_FATAL_FAILURE(expectSameSteps(world, other, 120, 1.0 / 60.0));
        // The boxes of solids are made anew: bodies that are put somewhere must find the same room.
        Random random(seed);
        for (int i = 0; i < 200; ++i) {
            const Vec3 position = random.inBox(5.0);
            ASSERT_EQ(world.setPosition(bodies.back(), position).ok(), other.setPosition(bodies.back(), position).ok());
        }
    }
}

TEST(Snapshot, RollsEightFramesOfAHundredBodiesBackAndOn) {
    World world = worldWith();
    World straight = worldWith();
    BusyRoom room(31, 100);
    BusyRoom same_room(31, 100);
    room.furnish(world, world);
    same_room.furnish(straight, straight);
    constexpr int kFrames = 8;
    std::vector<Bytes> ring(kFrames);
    for (int frame = 0; frame < 64; ++frame) {
        world.snapshotInto(ring[static_cast<std::size_t>(frame % kFrames)]);
        if (frame >= kFrames - 1) {
            // The oldest frame in the ring, and on to this one.
            ASSERT_TRUE(world.restore(ring[static_cast<std::size_t>((frame + 1) % kFrames)]).ok());
            for (int k = 0; k < kFrames - 1; ++k) {
                world.step(1.0 / 60.0);
            }
        }
        ASSERT_EQ(world.stateHash(), straight.stateHash()) << "frame " << frame;
        ASSERT_EQ(world.snapshot(), straight.snapshot()) << "frame " << frame;
        world.step(1.0 / 60.0);
        straight.step(1.0 / 60.0);
    }
}

TEST(Snapshot, ReusedMemoryStaysWhereItIs) {
    World world = worldWith();
    BusyRoom room(33);
    room.furnish(world, world);
    Bytes buffer;
    world.snapshotInto(buffer);
    EXPECT_EQ(buffer, world.snapshot());
    const std::byte* const place = buffer.data();
    for (int i = 0; i < 10; ++i) {
        world.snapshotInto(buffer);
        EXPECT_EQ(buffer.data(), place);
    }
    EXPECT_EQ(buffer, world.snapshot());
}

TEST(Snapshot, FindsShapesAmongTheKnownAndSaysWhenItCannot) {
    World world = worldWithFloor();
    const ShapePtr ball = valueOf(Shape::sphere(0.5));
    BodyDef def;
    def.shape = ball;
    def.position = {0, 5, 0};
    const BodyId id = valueOf(world.addBody(def));
    const Bytes bytes = world.snapshot();
    World other = worldWith();
    const Status refused = other.restore(bytes);
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.error().message.find("include_shapes"), std::string::npos) << refused.error().text();
    // Made alike, it is the same shape.
    const std::vector<ShapePtr> known{nullptr, valueOf(Shape::box({1, 1, 1})), valueOf(Shape::sphere(0.5))};
    ASSERT_TRUE(other.restore(bytes, known).ok());
    EXPECT_EQ(other.shape(id), known[2]);
    EXPECT_NE(known[1]->contentHash(), ball->contentHash());
    ASSERT_NO_FATAL_FAILURE(expectSameSteps(world, other, 100, 1.0 / 60.0));
}

TEST(Snapshot, ShapesComeBackToTheBit) {
    Random random(5);
    std::vector<Vec3> points;
    for (int i = 0; i < 60; ++i) {
        points.push_back(Vec3(3.0, 1.0, 2.0) * random.direction() + Vec3(7.0, 0.0, 0.0));
    }
    for (const ShapePtr& shape :
         {valueOf(Shape::sphere(0.3)), valueOf(Shape::cone(0.3, 0.7)), valueOf(Shape::capsule(0.1, 0.9)),
          valueOf(Shape::hull(points)), valueOf(Shape::box({1e-3, 2.0, 1e3}))}) {
        World world = worldWithFloor();
        BodyDef def;
        def.shape = shape;
        def.position = {0, 1e4, 0};
        const BodyId id = valueOf(world.addBody(def));
        const World other = worldFrom(world.snapshot({.include_shapes = true}));
        const ShapePtr& back = other.shape(id);
        EXPECT_NE(back, shape);
        EXPECT_EQ(back->contentHash(), shape->contentHash());
        EXPECT_TRUE(std::equal(back->vertices().begin(), back->vertices().end(), shape->vertices().begin()));
        EXPECT_EQ(back->extents(), shape->extents());
        EXPECT_EQ(back->volume(), shape->volume());
        EXPECT_EQ(back->radius(), shape->radius());
        EXPECT_EQ(back->centroidOfInput(), shape->centroidOfInput());
        EXPECT_EQ(back->boundingRadius(), shape->boundingRadius());
    }
}

/// A ball over a floor and a box on a path, in an impact: small, with something of everything.
World smallWorld() {
    World world = worldWithFloor();
    ObstacleDef lift;
    lift.shape = valueOf(Shape::box({2, 1, 2}));
    lift.position = {0.9, -0.2, 0.0};
    lift.path = {{1.0, {0.9, 0.3, 0.0}, kNoRotation}, {2.0, {0.9, -0.2, 0.0}, kNoRotation}};
    lift.path_repeats = true;
    EXPECT_TRUE(world.addObstacle(lift).ok());
    BodyDef def;
    def.shape = lift.shape;
    for (const double x : {-1.5, 0.4, 4.0}) {
        def.position = {x, 1.8, 0.0};
        def.velocity = {2.0, -3.0, 0.0};
        EXPECT_TRUE(world.addBody(def).ok());
        def.position.y += 1.0;
    }
    for (int i = 0; i < 21; ++i) {
        world.step(1.0 / 60.0);
    }
    EXPECT_TRUE(world.setVelocity(world.bodies().back(), {1, 2, 3}).ok());
    return world;
}

class Refusals : public testing::Test {
protected:
    /// Refused with words like these, and nothing has changed.
    void expectRefused(const Bytes& bytes, const std::string& words) {
        const Status status = world_.restore(bytes);
        ASSERT_FALSE(status.ok()) << words;
        EXPECT_NE(status.error().text().find(words), std::string::npos) << status.error().text();
    }
    void TearDown() override {
        EXPECT_EQ(world_.snapshot(), bytes_);
        World other = smallWorld();
        expectSameSteps(world_, other, 200, 1.0 / 60.0);
    }
    [[nodiscard]] Bytes sealed(Bytes bytes) const {
        const std::uint64_t checksum = checksumOf(bytes);
        for (std::size_t i = 0; i < 8; ++i) {
            bytes[kChecksumPlace + i] = static_cast<std::byte>(checksum >> 8 * i & 0xff);
        }
        return bytes;
    }
    template <class T>
    [[nodiscard]] Bytes with(std::size_t place, T value) const {
        Bytes bytes = bytes_;
        std::memcpy(bytes.data() + place, &value, sizeof value);
        return sealed(bytes);
    }
    /// Where this number is for the n-th time.
    [[nodiscard]] std::size_t placeOf(double value, int nth = 0) const {
        for (std::size_t place = 40; place + 8 <= bytes_.size(); ++place) {
            std::uint64_t bits = 0;
            std::memcpy(&bits, bytes_.data() + place, 8);
            if (bits == std::bit_cast<std::uint64_t>(value) && nth-- == 0) {
                return place;
            }
        }
        ADD_FAILURE() << value << " is not in the snapshot";
        return 40;
    }

    World world_ = smallWorld();
    Bytes bytes_ = world_.snapshot();
};

TEST_F(Refusals, EveryTruncation) {
    for (std::size_t length = 0; length < bytes_.size(); ++length) {
        const Bytes cut(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(length));
        ASSERT_FALSE(world_.restore(cut).ok()) << length;
    }
    expectRefused(Bytes(bytes_.begin(), bytes_.begin() + 31), "has 31 bytes; a snapshot has at least 32");
    expectRefused(Bytes(bytes_.begin(), bytes_.begin() + 100), "has 100: it was cut");
    Bytes longer = bytes_;
    longer.emplace_back();
    expectRefused(longer, "cut or added to");
}

TEST_F(Refusals, EveryTruncationThatIsSealedAgain) {
    for (std::size_t length = kEnvelopeBytes; length < bytes_.size(); ++length) {
        Bytes cut(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(length));
        const std::uint64_t said = length;
        std::memcpy(cut.data() + 16, &said, 8);
        // The list of shapes is at the end: what is cut off before it would be, too.
        const std::uint64_t shapes_at = length >= 4 + 40 ? length - 4 : 40;
        if (length >= 44) {
            std::memcpy(cut.data() + 32, &shapes_at, 8);
            std::memset(cut.data() + shapes_at, 0, 4);
        }
        ASSERT_FALSE(world_.restore(sealed(cut)).ok()) << length;
    }
}

TEST_F(Refusals, EverySingleBit) {
    Bytes bytes = bytes_;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        for (int bit = 0; bit < 8; ++bit) {
            bytes[i] ^= std::byte{1} << bit;
            ASSERT_FALSE(world_.restore(bytes).ok()) << "byte " << i << ", bit " << bit;
            bytes[i] ^= std::byte{1} << bit;
        }
    }
    EXPECT_TRUE(world_.restore(bytes).ok());
}

TEST_F(Refusals, OtherVersionsAndForeignBytes) {
    expectRefused(with(8, std::uint32_t{1}), "is of version 1; this library reads and writes version 2");
    expectRefused(with(0, 'X'), "letters ELASTOON");
    expectRefused(with(12, std::uint32_t{6}), "flags must be 0 or 1");
    Bytes damaged = bytes_;
    damaged[200] ^= std::byte{4};
    expectRefused(damaged, "it is damaged");
}

TEST_F(Refusals, DamageUnderAGoodChecksum) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    expectRefused(with(40, nan), "the time is unsound");
    expectRefused(with(40, -1.0), "the time is unsound");
    expectRefused(with(48, nan), "the gravity is unsound");
    expectRefused(with(32, std::uint64_t{1} << 40), "the list of shapes must lie within it");
    // Counts: of free obstacles, and of shapes.
    expectRefused(with(80, std::uint32_t{0xffffffff}), "end too soon");
    expectRefused(with(80, std::uint32_t{1}), "unsound");
    std::uint64_t shapes_at = 0;
    std::memcpy(&shapes_at, bytes_.data() + 32, 8);
    expectRefused(with(shapes_at, std::uint32_t{0xffffff}), "list of shapes is damaged");
    expectRefused(with(shapes_at, std::uint32_t{0}), "unsound");
    expectRefused(with(shapes_at + 4, std::uint64_t{12345}), "is not known here");
    expectRefused(with(shapes_at + 12, std::uint32_t{9}), "other counts");
    // Numbers of the bodies' styles, flights and impacts.
    expectRefused(with(placeOf(Style{}.rest_slope), 4.0), "style.rest_slope: must be from 0 to 90");
    expectRefused(with(placeOf(Style{}.reversal_rate), nan), "style.reversal_rate");
    const Phase& phase = world_.phase(world_.bodies().back());
    expectRefused(with(placeOf(phase.start, 1), 1e6), "unsound");
    expectRefused(with(placeOf(phase.get<Flight>().up.y, 0), nan), "unsound");
}

/// Every number of eight bytes gets values that it should not have: what passes must go on without a fault.
TEST(Snapshot, WhatIsOddAndPassesGoesOn) {
    World world = smallWorld();
    const Bytes bytes = world.snapshot();
    const double values[] = {std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(),
                             -1.0,
                             0.0,
                             1e300,
                             1e9,
                             1e-300};
    int passed = 0;
    int refused = 0;
    for (std::size_t place = 40; place + 8 <= bytes.size(); place += 1) {
        for (const double value : values) {
            Bytes odd = bytes;
            std::memcpy(odd.data() + place, &value, 8);
            const std::uint64_t checksum = checksumOf(odd);
            std::memcpy(odd.data() + kChecksumPlace, &checksum, 8);
            if (!world.restore(odd).ok()) {
                ++refused;
                continue;
            }
            ++passed;
            for (int i = 0; i < 3; ++i) {
                world.step(1.0 / 60.0);
            }
            ASSERT_TRUE(world.restore(bytes).ok());
        }
    }
    EXPECT_GT(passed, 1000);
    EXPECT_GT(refused, 1000);
}

TEST(Snapshot, PathsAreSafeToRepeat) {
    World world = worldWith();
    ObstacleDef def;
    def.path = {{1e-4, {0, 1, 0}, kNoRotation}};
    def.path_repeats = true;
    const auto refused = world.addObstacle(def);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().text(), "path: must take at least 0.001 s to repeat, takes 0.0001");
    def.path = {{1e-9, {0, 1, 0}, kNoRotation}, {1.0, {0, 0, 0}, kNoRotation}};
    const auto too_fast = world.addObstacle(def);
    ASSERT_FALSE(too_fast.ok());
    EXPECT_EQ(too_fast.error().text(),
              "path[0]: is too far for so short a time: that would take 1e+09 m/s and 0 rad/s, "
              "and the most is 1e6 m/s and 1e4 rad/s");
    // A key that the clock cannot tell from the lap's start.
    def.path = {{1e-300, {0, 0, 0}, kNoRotation}, {0.5, {0, 1, 0}, kNoRotation}};
    ASSERT_TRUE(world.addObstacle(def).ok());
    for (int i = 0; i < 50; ++i) {
        world.step(0.1);
    }
    EXPECT_NEAR(world.time(), 5.0, 1e-9);
}

} // namespace
} // namespace elastoon
