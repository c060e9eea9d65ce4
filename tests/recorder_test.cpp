// Recordings: the same inputs give the same world, also by way of bytes, and with inputs that come late.
#include "elastoon/recorder.h"

#include "byte_stream.h"
#include "snapshot_support.h"

namespace elastoon {
namespace {

using Bytes = std::vector<std::byte>;

/// A room that its user changes for a while.
Recording recordingOf(std::uint64_t seed, int steps, World& world) {
    Recorder recorder(world);
    BusyRoom room(seed);
    room.furnish(recorder, world);
    for (int i = 0; i < steps; ++i) {
        room.change(recorder, world);
        for (const BodyId id : world.bodies()) {
            if (i % 3 == 0 && world.phase(id).is<Impact>()) {
                (void)recorder.steerImpact(id, {0.3, 4.0, 0.2}); // refused where it does not part from the surface
            }
        }
        recorder.step(i % 5 == 0 ? 1.0 / 30.0 : 1.0 / 60.0);
    }
    return recorder.recording();
}

TEST(Recorder, ReplaysToTheSameBits) {
    std::vector<bool> seen(std::variant_size_v<Input>, false);
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        World world = worldWith();
        const Recording recording = recordingOf(seed, 240, world);
        for (const TimedInput& timed : recording.inputs) {
            seen[timed.input.index()] = true;
        }
        const World again = valueOf(replay(recording));
        EXPECT_EQ(again.stateHash(), world.stateHash());
        EXPECT_EQ(again.snapshot({.include_shapes = true}), world.snapshot({.include_shapes = true}));
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), true), static_cast<std::ptrdiff_t>(seen.size()))
        << "every kind of input is to occur";
}

TEST(Recorder, BeginsAnywhere) {
    World world = worldWith();
    recordingOf(3, 100, world);
    Recorder recorder(world);
    EXPECT_TRUE(recorder.setVelocity(world.bodies().front(), {1, 5, 1}).ok());
    for (int i = 0; i < 50; ++i) {
        recorder.step(1.0 / 60.0);
    }
    EXPECT_EQ(valueOf(replay(recorder.recording())).snapshot(), world.snapshot());
}

TEST(Recorder, RefusedCallsAreNotKept) {
    World world = worldWithFloor();
    Recorder recorder(world);
    EXPECT_FALSE(recorder.addBody({}).ok());
    EXPECT_FALSE(recorder.removeBody({1, 1}));
    EXPECT_FALSE(recorder.removeObstacle({9, 1}));
    EXPECT_FALSE(recorder.setVelocity({1, 1}, {1, 0, 0}).ok());
    EXPECT_FALSE(recorder.setGravity(Vec3(std::nan(""))).ok());
    EXPECT_TRUE(recorder.recording().inputs.empty());
}

TEST(Recorder, ComesBackFromItsBytes) {
    World world = worldWith();
    const Recording recording = recordingOf(7, 120, world);
    const Bytes bytes = recording.toBytes();
    const Recording back = valueOf(Recording::fromBytes(bytes));
    EXPECT_EQ(back.toBytes(), bytes);
    EXPECT_EQ(valueOf(replay(back)).stateHash(), world.stateHash());
}

TEST(Recorder, LateInputsGoIntoTheirStep) {
    constexpr int kLate = 20;
    World straight = worldWith();
    World world = worldWith();
    BusyRoom room(9);
    BusyRoom same_room(9);
    Recorder recorder(world);
    room.furnish(recorder, world);
    same_room.furnish(straight, straight);
    Bytes before_late;
    const BodyId body = world.bodies().front();
    for (int i = 0; i < kLate + 8; ++i) {
        if (i == kLate) {
            world.snapshotInto(before_late);
            ASSERT_TRUE(straight.setVelocity(body, {0, 9, 0}).ok());
        }
        recorder.step(1.0 / 60.0);
        straight.step(1.0 / 60.0);
    }
    ASSERT_NE(world.stateHash(), straight.stateHash());
    recorder.insert(kLate, input::SetVelocity{body, {0, 9, 0}});
    ASSERT_TRUE(world.restore(before_late).ok());
    ASSERT_TRUE(replay(recorder.recording(), world, kLate).ok());
    EXPECT_EQ(world.stateHash(), straight.stateHash());
    EXPECT_EQ(world.snapshot(), straight.snapshot());
    EXPECT_EQ(valueOf(replay(recorder.recording())).stateHash(), straight.stateHash());
}

TEST(Recorder, PartsOfAReplayAddUp) {
    World world = worldWith();
    const Recording recording = recordingOf(13, 90, world);
    World other = worldWith();
    ASSERT_TRUE(other.restore(recording.start).ok());
    for (std::size_t step = 0; step < recording.steps.size(); step += 10) {
        ASSERT_TRUE(replay(recording, other, step, step + 10).ok());
    }
    EXPECT_EQ(other.snapshot({.include_shapes = true}), world.snapshot({.include_shapes = true}));
}

TEST(Recorder, InputsAfterTheLastStepComeOnceAndLast) {
    World world = worldWithFloor();
    Recorder recorder(world);
    recorder.step(0.1);
    recorder.step(0.1);
    const auto before = world.snapshot();
    BodyDef def;
    def.shape = valueOf(Shape::sphere(0.5));
    def.position = {0, 3, 0};
    (void)valueOf(recorder.addBody(def));
    World other = worldWith();
    ASSERT_TRUE(other.restore(recorder.recording().start).ok());
    ASSERT_TRUE(replay(recorder.recording(), other, 0, 1).ok());
    ASSERT_TRUE(replay(recorder.recording(), other, 1, 2).ok());
    EXPECT_EQ(other.snapshot(), before);
    ASSERT_TRUE(replay(recorder.recording(), other, 2).ok());
    EXPECT_EQ(other.snapshot({.include_shapes = true}), world.snapshot({.include_shapes = true}));
}

TEST(Recorder, GoesAnotherWayFromACut) {
    World world = worldWith();
    BusyRoom room(15);
    Recorder recorder(world);
    room.furnish(recorder, world);
    Bytes before;
    for (std::size_t i = 0; i < 40; ++i) {
        if (i == 25) {
            world.snapshotInto(before);
        }
        room.change(recorder, world);
        recorder.step(1.0 / 60.0);
    }
    ASSERT_TRUE(world.restore(before).ok());
    recorder.cut(25);
    EXPECT_EQ(recorder.recording().steps.size(), 25U);
    EXPECT_LT(recorder.recording().inputs.back().step, 25U);
    ASSERT_TRUE(recorder.setGravity({0, 3, 0}).ok());
    for (int i = 0; i < 10; ++i) {
        recorder.step(1.0 / 50.0);
    }
    EXPECT_EQ(valueOf(replay(recorder.recording())).snapshot(), world.snapshot());
    recorder.cut(1000); // nothing is there
    EXPECT_EQ(recorder.recording().steps.size(), 35U);
}

TEST(Recorder, SaysWhereAReplayLeavesTheRecording) {
    World world = worldWithFloor();
    Recorder recorder(world);
    recorder.step(0.1);
    BodyDef def;
    def.shape = valueOf(Shape::sphere(0.5));
    def.position = {0, 3, 0};
    const BodyId id = valueOf(recorder.addBody(def));
    Recording recording = recorder.recording();
    recording.insert(0, input::AddBody{def, {}});
    const auto other_id = replay(recording);
    ASSERT_FALSE(other_id.ok());
    EXPECT_EQ(other_id.error().text().rfind("step 1, addBody: id: was given another id", 0), 0U)
        << other_id.error().text();
    recording = recorder.recording();
    recording.insert(0, input::SetVelocity{id, {0, 0, 0}});
    const auto unknown = replay(recording);
    ASSERT_FALSE(unknown.ok());
    EXPECT_EQ(unknown.error().where, "step 0, setVelocity");
}

TEST(Recorder, DamagedBytesAreRefused) {
    World world = worldWithFloor();
    Recorder recorder(world);
    BodyDef def;
    def.shape = valueOf(Shape::box({1, 1, 1}));
    def.position = {0, 3, 0};
    const BodyId id = valueOf(recorder.addBody(def));
    recorder.step(0.1);
    ASSERT_TRUE(recorder.setVelocity(id, {1, 0, 0}).ok());
    ASSERT_TRUE(recorder.setStyle(id, {}).ok());
    const Bytes bytes = recorder.recording().toBytes();
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        ASSERT_FALSE(Recording::fromBytes(std::span(bytes).first(length)).ok()) << length;
    }
    Bytes flipped = bytes;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        for (int bit = 0; bit < 8; ++bit) {
            flipped[i] ^= std::byte{1} << bit;
            ASSERT_FALSE(Recording::fromBytes(flipped).ok()) << "byte " << i;
            // Under a good checksum it is refused, or can be replayed, if only to a refusal.
            Bytes sealed = flipped;
            const std::uint64_t checksum = checksumOf(sealed);
            std::memcpy(sealed.data() + kChecksumPlace, &checksum, 8);
            if (const auto read = Recording::fromBytes(sealed)) {
                (void)replay(read.value());
            } else {
                EXPECT_FALSE(read.error().message.empty());
            }
            flipped[i] ^= std::byte{1} << bit;
        }
    }
    const auto foreign = Recording::fromBytes(world.snapshot());
    ASSERT_FALSE(foreign.ok());
    EXPECT_EQ(foreign.error().text(), "recording: does not begin with the letters ELASTREC: it is no recording");
}

} // namespace
} // namespace elastoon
