// libFuzzer target: bytes as a snapshot, or as changes of a good one, sealed so that they get past the checksum. What
// is refused leaves the world as it was; what is restored can be stepped, and its snapshot restored again.
// scripts/fuzz.sh runs it.
#include "byte_stream.h"
#include "bytes.h"
#include "elastoon/world.h"

#include <array>
#include <vector>

namespace elastoon {
namespace {

using Snapshot = std::vector<std::byte>;

const std::array<ShapePtr, 3>& shapes() {
    static const std::array<ShapePtr, 3> kShapes{Shape::box({1, 0.5, 0.75}).value(), Shape::sphere(0.5, 2).value(),
                                                 Shape::cylinder(0.5, 1.0, 8).value()};
    return kShapes;
}

/// A floor, a solid that stands, one that goes round; bodies that fly, squash, rest; a user's change that waits.
World stagedWorld(int steps) {
    World world = World::create().value();
    world.addObstacle(ObstacleDef::plane({0, 1, 0}, 0)).value();
    ObstacleDef solid;
    solid.shape = shapes()[0];
    solid.position = {0.3, 0.4, 0.0};
    solid.angular_velocity = {0.0, 0.5, 0.0};
    const ObstacleId gone = world.addObstacle(solid).value();
    solid.position.x = 2.5;
    solid.path = {{0.3, {2.5, 1.0, 0.0}, kNoRotation}, {0.7, {2.5, 0.4, 0.0}, kNoRotation}};
    solid.path_repeats = true;
    world.addObstacle(solid).value();
    BodyDef def;
    for (int i = 0; i < 3; ++i) {
        def.shape = shapes()[static_cast<std::size_t>(i)];
        def.position = {1.3 * i, 2.0 + 0.2 * i, 0.1 * i};
        def.velocity = {0.5 * i, -1.0, 0.0};
        def.style.restitution = 0.2 * i;
        world.addBody(def).value();
    }
    for (int i = 0; i < steps; ++i) {
        world.step(1.0 / 60.0);
    }
    if (steps % 2 == 1) {
        world.removeObstacle(gone);
        demand(world.setVelocity(world.bodies().front(), {1, 2, 0}).ok(), "a velocity that is refused");
    }
    return world;
}

const Snapshot& goodSnapshot(std::size_t index) {
    static const std::vector<Snapshot> kGood = [] {
        std::vector<Snapshot> good;
        for (const int steps : {0, 20, 33, 39, 50, 61, 90, 140}) {
            good.push_back(stagedWorld(steps).snapshot({.include_shapes = steps % 3 == 0}));
        }
        return good;
    }();
    return kGood[index % kGood.size()];
}

void setWord(Snapshot& snapshot, std::size_t place, std::uint64_t word) {
    for (std::size_t i = 0; i < 8 && place + i < snapshot.size(); ++i) {
        snapshot[place + i] = static_cast<std::byte>(word >> 8 * i & 0xff);
    }
}

Snapshot changed(Bytes& bytes) {
    Snapshot snapshot = goodSnapshot(bytes.next());
    while (bytes.any()) {
        const std::uint8_t kind = bytes.next();
        const std::size_t place = kEnvelopeBytes + (bytes.next() * 256U + bytes.next()) % (snapshot.size() - 40);
        if (kind < 96) {
            setWord(snapshot, place, bitsOf(coordinate(bytes)));
        } else if (kind < 160) {
            snapshot[place] ^= std::byte{1} << kind % 8;
        } else if (kind < 224) {
            snapshot[place] = static_cast<std::byte>(bytes.next());
        } else if (kind < 240) {
            snapshot.erase(snapshot.begin() + static_cast<std::ptrdiff_t>(place));
        } else {
            snapshot.insert(snapshot.begin() + static_cast<std::ptrdiff_t>(place),
                            static_cast<std::byte>(bytes.next()));
        }
        if (snapshot.size() < 64) {
            break;
        }
    }
    return snapshot;
}

/// With the head, length and checksum of a snapshot.
void seal(Snapshot& snapshot) {
    std::copy_n(goodSnapshot(0).begin(), 12, snapshot.begin());
    snapshot[12] &= std::byte{1};
    snapshot[13] = snapshot[14] = snapshot[15] = std::byte{0};
    setWord(snapshot, 16, snapshot.size());
    setWord(snapshot, kChecksumPlace, checksumOf(snapshot));
}

void runOn(Bytes& bytes) {
    Snapshot snapshot;
    if (bytes.next() % 4 == 0) {
        while (bytes.any()) {
            snapshot.push_back(static_cast<std::byte>(bytes.next()));
        }
        snapshot.resize(std::max<std::size_t>(snapshot.size(), 40));
    } else {
        snapshot = changed(bytes);
    }
    seal(snapshot);
    static World world = stagedWorld(5);
    const Snapshot& start = goodSnapshot(0);
    demand(world.restore(start, shapes()).ok(), "a good snapshot is refused");
    const std::uint64_t before = world.stateHash();
    const Status status = world.restore(snapshot, shapes());
    if (!status) {
        demand(!status.error().message.empty(), "an error without a message");
        demand(world.stateHash() == before, "a refused snapshot has changed the world");
        return;
    }
    const Snapshot again = world.snapshot();
    demand(world.restore(again).ok(), "the snapshot of a restored world is refused");
    demand(world.snapshot() == again, "a restored snapshot is another one");
    for (int i = 0; i < 10; ++i) {
        world.step(1.0 / 60.0);
    }
}

} // namespace
} // namespace elastoon

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    elastoon::Bytes bytes(data, size);
    elastoon::runOn(bytes);
    return 0;
}
