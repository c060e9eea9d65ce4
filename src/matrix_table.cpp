// See matrix_table.h. A test holds the lanes equal to poseAt().
#include "matrix_table.h"

#include "flight.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>
#include <variant>

namespace elastoon {

namespace {

/// Sixteen whole matrices, one after another: four by four of the columns turned at a time.
void writeAll(const Columns& columns, float* out) {
    using Four [[gnu::vector_size(16)]] = float;
    constexpr std::size_t kFour = 4;
    for (std::size_t k = 0; k < MatrixTable::kFloats; k += kFour) {
        for (std::size_t i = 0; i < kLanes; i += kFour) {
            Four a, b, c, d;
            std::memcpy(&a, &columns[k][i], sizeof a);
            std::memcpy(&b, &columns[k + 1][i], sizeof b);
            std::memcpy(&c, &columns[k + 2][i], sizeof c);
            std::memcpy(&d, &columns[k + 3][i], sizeof d);
            const Four ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5);
            const Four ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
            const Four cd_low = __builtin_shufflevector(c, d, 0, 4, 1, 5);
            const Four cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
            const std::array<Four, kFour> rows{__builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5),
                                               __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7),
                                               __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5),
                                               __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7)};
            for (std::size_t row = 0; row < kFour; ++row) {
                std::memcpy(out + MatrixTable::kFloats * (i + row) + k, &rows[row], sizeof(Four));
            }
        }
    }
}

/// One of them.
void writeOne(const Columns& columns, std::size_t lane, float* out) {
    for (std::size_t k = 0; k < MatrixTable::kFloats; ++k) {
        out[k] = columns[k][lane];
    }
}

/// Calls what(slot) for each bit, from `begin` on.
template <class What>
void forEach(std::uint32_t some, std::size_t begin, What&& what) {
    for (; some != 0; some &= some - 1) {
        what(begin + static_cast<std::size_t>(std::countr_zero(some)));
    }
}

} // namespace

void MatrixTable::writePose(std::size_t slot, const BodySlot& body, double t) {
    const Pose pose = poseAt(body.phase, *body.shape, t);
    const Mat3 linear = linearOf(pose);
    float* out = &matrices_[kFloats * slot];
    for (int column = 0; column < 4; ++column) {
        const Vec3& from = column < 3 ? linear[column] : pose.position;
        for (int row = 0; row < 3; ++row) {
            *out++ = static_cast<float>(from[row]);
        }
    }
}

namespace {

/// From then on a flight is on its own way.
double freeAt(const Phase& phase) {
    return phase.clear_of.empty() ? phase.start : phase.free_from;
}

} // namespace

Flight MatrixTable::flight(std::size_t slot) const {
    Flight flight;
    blocks_[slot / kLanes].lanes.get(slot % kLanes, gravity_, flight);
    return flight;
}

namespace {

/// Room for the flight that is given back and, mostly, taken again soon after.
thread_local Boxed<Flight> spare;

} // namespace

bool MatrixTable::giveBack(std::size_t slot, Phase& phase) const {
    const bool taken = isTaken(phase);
    if (taken) {
        Flight& flight = phase.motion.emplace<Boxed<Flight>>(std::move(spare)).edit();
        blocks_[slot / kLanes].lanes.get(slot % kLanes, gravity_, flight);
    }
    return taken;
}

void MatrixTable::takeAgain(Phase& phase) {
    spare = std::exchange(std::get<Boxed<Flight>>(phase.motion), {});
}

bool MatrixTable::canBeTaken(const Phase& phase) {
    return phase.is<Flight>() && !isTaken(phase) && phase.get<Flight>().ease.isUsual();
}

void MatrixTable::begun(std::size_t slot, Phase& phase, double t) {
    if (slot >= changed_.size()) {
        return;
    }
    Change& change = changed_[slot];
    // Where gravity is another since, the lanes are emptied when they are drawn.
    if (!canBeTaken(phase) || phase.get<Flight>().gravity != gravity_) {
        change = phase.is<Impact>() ? Change::Posed : Change::Unknown;
    } else if (t >= freeAt(phase)) {
        blocks_[slot / kLanes].lanes.set(slot % kLanes, phase.start, phase.get<Flight>());
        takeAgain(phase);
        change = Change::Taken;
    } else {
        change = Change::ToTake;
    }
}

void MatrixTable::Block::set(std::size_t lane, Change change) {
    const Some bit = Some{1} << lane;
    const auto put = [bit](Some& some, bool is_one) { some = is_one ? some | bit : some & ~bit; };
    put(taken, change == Change::Taken);
    put(written, change == Change::None);
    put(posed, change == Change::Posed || change == Change::ToTake);
    put(to_take, change == Change::ToTake);
}

/// Finds out how the body is to be drawn from now on. What stays as it is is drawn at once: None.
MatrixTable::Change MatrixTable::look(std::size_t slot, const BodySlot& body, double t) {
    const Phase& phase = body.phase;
    const auto* rest = phase.as<Rest>();
    if (!body.used) {
        std::fill_n(&matrices_[kFloats * slot], kFloats, 0.0F);
        return Change::None;
    }
    if (isTaken(phase)) {
        return Change::Taken;
    }
    if (rest != nullptr && !rest->surface.frame.moves() && phase.clear_of.empty()) {
        writePose(slot, body, t);
        return Change::None;
    }
    return canBeTaken(phase) ? Change::ToTake : Change::Posed;
}

void MatrixTable::takeFlights(std::size_t index, double t, LargeArray<BodySlot>& bodies) {
    const std::size_t begin = index * kLanes;
    Change* changes = &changed_[begin];
    Block& block = blocks_[index];
    static constexpr std::array<Change, kLanes> kNone{};
    if (std::memcmp(changes, kNone.data(), kLanes) != 0) {
        Some changed = 0;
        for (std::size_t i = 0; i < std::min(kLanes, bodies.size() - begin); ++i) {
            changed |= (changes[i] != Change::None ? Some{1} : Some{0}) << i;
        }
        forEach(changed, 0, [&](std::size_t i) {
            const bool known = changes[i] != Change::Unknown;
            block.set(i, known ? changes[i] : look(begin + i, bodies[begin + i], t));
            changes[i] = Change::None;
        });
    }
    forEach(block.to_take, begin, [&](std::size_t slot) {
        Phase& phase = bodies[slot].phase;
        if (t >= freeAt(phase)) {
            const Some bit = Some{1} << (slot - begin);
            block.lanes.set(slot - begin, phase.start, phase.get<Flight>());
            takeAgain(phase);
            block.taken |= bit;
            block.posed &= ~bit;
            block.to_take &= ~bit;
        }
    });
}

void MatrixTable::writePosed(std::span<const std::uint32_t> slots, double t, const LargeArray<BodySlot>& bodies) {
    constexpr std::size_t kSlotsAhead = 24;
    constexpr std::size_t kRestAhead = 12;
    // What others have left in its lanes is worked out and not used: cheaper than to clear them.
    thread_local Impacts impacts;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        if (i + kSlotsAhead < slots.size()) {
            prefetchSlot(bodies[slots[i + kSlotsAhead]]);
        }
        if (i + kRestAhead < slots.size()) {
            prefetchRest(bodies[slots[i + kRestAhead]]);
        }
        const BodySlot& body = bodies[slots[i]];
        if (!ImpactLanes::fits(body.phase)) {
            writePose(slots[i], body, t);
            continue;
        }
        impacts.slots[impacts.count] = slots[i];
        impacts.lanes.set(impacts.count, body.phase.get<Impact>(), *body.shape);
        if (++impacts.count == kLanes) {
            writeImpacts(t, impacts);
        }
    }
    writeImpacts(t, impacts);
}

void MatrixTable::writeImpacts(double t, Impacts& impacts) {
    if (impacts.count == 0) {
        return;
    }
    Columns columns;
    poseImpacts(impacts.lanes, impacts.count, t, columns);
    for (std::size_t i = 0; i < impacts.count; ++i) {
        writeOne(columns, i, &matrices_[kFloats * impacts.slots[i]]);
    }
    impacts.count = 0;
}

void MatrixTable::writeFlights(std::size_t index, const Falling& falling, double t) {
    const Block& block = blocks_[index];
    if (block.taken == 0) {
        return;
    }
    Columns columns;
    poseFlights(block.lanes, falling, t, columns);
    float* out = &matrices_[kFloats * kLanes * index];
    if (block.written == 0) {
        // Of those that are posed something is written too: their own matrices come after.
        writeAll(columns, out);
        return;
    }
    forEach(block.taken, 0, [&](std::size_t lane) { writeOne(columns, lane, out + kFloats * lane); });
}

/// Batches of one kind: what poses are worked out with stays in the nearest cache, and the matrices in the next.
void MatrixTable::writeBlocks(std::size_t begin, std::size_t end, double t, LargeArray<BodySlot>& bodies) {
    constexpr std::size_t kBatch = 64;
    constexpr std::size_t kBlocksAhead = 2;
    constexpr std::size_t kBlocksNearby = 1024; // so many stay in a cache, and come soon enough without being asked for
    const bool are_many = blocks_.size() > kBlocksNearby;
    const Falling falling(gravity_);
    std::array<std::uint32_t, kBatch * kLanes> posed;
    for (std::size_t first = begin; first < end; first += kBatch) {
        std::size_t count = 0;
        for (std::size_t i = first; i < std::min(end, first + kBatch); ++i) {
            if (are_many && i + kBlocksAhead < end) {
                prefetch(&blocks_[i + kBlocksAhead], sizeof(Block));
            }
            takeFlights(i, t, bodies);
            writeFlights(i, falling, t);
            forEach(blocks_[i].posed, i * kLanes,
                    [&](std::size_t slot) { posed[count++] = static_cast<std::uint32_t>(slot); });
        }
        writePosed(std::span(posed).first(count), t, bodies);
    }
}

std::span<const float> MatrixTable::at(double t, LargeArray<BodySlot>& bodies, const Vec3& gravity,
                                       const ParallelFor& parallel_for) {
    const std::size_t count = (bodies.size() + kLanes - 1) / kLanes;
    if (gravity != gravity_) {
        allChanged();
    }
    gravity_ = gravity;
    blocks_.resize(count);
    changed_.resize(kLanes * count, Change::Unknown);
    matrices_.resize(kFloats * kLanes * count);
    if (parallel_for) {
        parallel_for(count, [&](std::size_t begin, std::size_t end) { writeBlocks(begin, end, t, bodies); });
    } else {
        writeBlocks(0, count, t, bodies);
    }
    return std::span<const float>(matrices_).first(kFloats * bodies.size());
}

} // namespace elastoon
