// World::step: bodies and obstacles move on. docs/step.md.
#include "check_input.h"
#include "lock.h"
#include "prefetch.h"
#include "stopwatch.h"
#include "world_impl.h"

#include <algorithm>
#include <iterator>

namespace elastoon {

double World::Impl::nextPathChange(double to) const {
    double next = to;
    for (const std::size_t i : around.on_paths) {
        next = std::min(next, nextChange(around.obstacles[i].path, time));
    }
    return next;
}

/// Obstacles that have come to a key of their path take the next leg.
void World::Impl::followPaths() {
    const Stopwatch watch(clock, profile.follow_paths);
    const std::vector<std::size_t> on_paths = around.on_paths;
    for (const std::size_t i : on_paths) {
        const ObstacleSlot& obstacle = around.obstacles[i];
        const MovingFrame leg = frameAt(obstacle.path, time);
        if (leg.start > obstacle.frame.start) {
            setFrame(i, leg);
        }
    }
}

namespace {

/// Empties the list, and gives back room that the last step hardly used: a world that is filled has a phase for each
/// body.
template <class T>
void renew(std::vector<T>& list, std::vector<T>& pending) {
    constexpr std::size_t kLittle = 1024;
    const std::size_t wanted = 8 * std::max(list.size(), kLittle);
    list.clear();
    if (list.capacity() > wanted) {
        list.shrink_to_fit();
    }
    std::swap(list, pending);
}

} // namespace

void World::Impl::takePending() {
    renew(events, pending.events);
    renew(phases, pending.phases);
}

namespace {

template <class T>
void append(std::vector<T>& list, std::vector<T>& more) {
    list.insert(list.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
    more.clear();
}

} // namespace

void World::Impl::prepareStep(double until) {
    const Stopwatch watch(clock, profile.prepare);
    around.prepareStep(time, until);
}

Happenings World::Impl::spareHappenings() {
    if (spare.empty()) {
        return {};
    }
    Happenings out = std::move(spare.back());
    spare.pop_back();
    return out;
}

/// Bodies do not read each other, so any cut of the range gives the same motion.
void World::Impl::advanceBodies(double to) {
    const Stopwatch watch(clock, profile.advance);
    struct Part {
        std::size_t begin;
        Happenings out;
        std::size_t advanced = 0;
    };
    if (quiet_version != around.version) {
        quiet_until.assign(bodies.size(), kNotQuiet);
        quiet_version = around.version;
    }
    quiet_until.resize(bodies.size(), kNotQuiet);
    std::vector<Part> parts;
    Mutex guard;
    const auto advanceRange = [&](std::size_t begin, std::size_t end) {
        Part part{begin, {}, 0};
        {
            const Lock lock(guard);
            part.out = spareHappenings();
        }
        // Who is busy is found first, so that the next ones are on their way to the cache while one is advanced.
        constexpr std::size_t kSlotsAhead = 6;
        constexpr std::size_t kRestAhead = 3;
        thread_local std::vector<std::size_t> busy;
        busy.resize(std::max(busy.size(), end - begin));
        std::size_t count = 0;
        for (std::size_t i = begin; i < end; ++i) {
            busy[count] = i; // without a branch: who is busy nobody can foresee
            count += to >= quiet_until[i] ? 1 : 0;
        }
        for (std::size_t k = 0; k < count; ++k) {
            if (k + kSlotsAhead < count) {
                prefetchSlot(bodies[busy[k + kSlotsAhead]]);
                matrices.prefetchFlight(busy[k + kSlotsAhead]);
            }
            if (k + kRestAhead < count) {
                prefetchRest(bodies[busy[k + kRestAhead]]);
            }
            const std::size_t i = busy[k];
            if (!bodies[i].used) {
                quiet_until[i] = std::numeric_limits<double>::infinity();
                continue;
            }
            ++part.advanced;
            const bool was_taken = matrices.giveBack(i, bodies[i].phase);
            const std::size_t phases_before = part.out.phases.size();
            quiet_until[i] = advanceBody(around, bodies[i], idOfBody(i, bodies[i]), time, to, part.out);
            if (was_taken && part.out.phases.size() == phases_before) {
                MatrixTable::takeAgain(bodies[i].phase);
            } else {
                matrices.begun(i, bodies[i].phase, to);
            }
        }
        const Lock lock(guard);
        const auto later =
            std::partition_point(parts.begin(), parts.end(), [&](const Part& p) { return p.begin < begin; });
        parts.insert(later, std::move(part));
    };
    if (parallel_for) {
        parallel_for(bodies.size(), advanceRange);
    } else {
        advanceRange(0, bodies.size());
    }
    for (Part& part : parts) {
        profile.advanced += part.advanced;
        append(events, part.out.events);
        append(phases, part.out.phases);
        spare.push_back(std::move(part.out));
    }
}

void World::step(double dt) {
    const bool valid = dt >= 0.0 && dt <= kMostStep;
    ELASTOON_ASSERT(valid, "dt must be finite, not negative, and at most 1e6 s");
    if (!valid) {
        return;
    }
    impl_->profile = {};
    impl_->takePending();
    impl_->advance(impl_->time + dt);
}

namespace {

/// Where something belongs in a list: by time, then by body, then as it came.
struct Key {
    double time;
    std::uint32_t slot, place;

    bool operator<(const Key& other) const {
        return time != other.time ? time < other.time : slot != other.slot ? slot < other.slot : place < other.place;
    }
};

/// Sorts what is large by its keys: keyOf(item, place).
template <class Item, class KeyOf>
void sortByKey(std::vector<Item>& items, KeyOf&& keyOf) {
    const auto isBefore = [&](const Item& a, const Item& b) { return keyOf(a, 0) < keyOf(b, 0); };
    if (std::is_sorted(items.begin(), items.end(), isBefore)) {
        return;
    }
    thread_local std::vector<Key> keys;
    keys.clear();
    for (const Item& item : items) {
        keys.push_back(keyOf(item, static_cast<std::uint32_t>(keys.size())));
    }
    std::sort(keys.begin(), keys.end());
    thread_local std::vector<Item> sorted;
    sorted.clear();
    for (const Key& key : keys) {
        sorted.push_back(std::move(items[key.place]));
    }
    items.swap(sorted);
}

} // namespace

/// From one change of an obstacle's motion to the next.
void World::Impl::advance(double to) {
    do {
        const double until = nextPathChange(to);
        prepareStep(until);
        advanceBodies(until);
        time = until;
        followPaths();
        append(events, pending.events);
        append(phases, pending.phases);
    } while (time < to);
    const Stopwatch watch(clock, profile.sort_events);
    sortByKey(events, [](const Event& event, std::uint32_t place) { return Key{event.time, event.body.slot, place}; });
    sortByKey(phases, [](const PhaseBegun& phase, std::uint32_t place) { return Key{0.0, phase.body.slot, place}; });
}

} // namespace elastoon
