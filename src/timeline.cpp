// See timeline.h.
#include "elastoon/timeline.h"

#include "elastoon/assert.h"

#include <algorithm>

namespace elastoon {

const Phase& Track::phaseAt(double t) const {
    ELASTOON_ASSERT(!phases_.empty(), "the track has no phase");
    const auto after = std::upper_bound(phases_.begin(), phases_.end(), t,
                                        [](double time, const Phase& phase) { return time < phase.start; });
    return after == phases_.begin() ? phases_.front() : *std::prev(after);
}

Pose Track::poseAt(double t) const {
    return elastoon::poseAt(phaseAt(t), *shape_, t);
}

Vec3 Track::velocityAt(double t) const {
    return elastoon::velocityAt(phaseAt(t), *shape_, t);
}

Track* Timeline::trackOf(const World& world, BodyId body) {
    if (body.slot >= track_of_slot_.size()) {
        track_of_slot_.resize(body.slot + 1, 0);
    }
    std::size_t& entry = track_of_slot_[body.slot];
    if (entry != 0 && tracks_[entry - 1].body() == body) {
        return &tracks_[entry - 1];
    }
    if (!world.contains(body)) {
        return nullptr;
    }
    tracks_.emplace_back(body, world.shape(body));
    entry = tracks_.size();
    return &tracks_.back();
}

void Timeline::begin(const World& world) {
    *this = Timeline{};
    start_ = end_ = world.time();
    for (const BodyId id : world.bodies()) {
        trackOf(world, id)->phases_.push_back(world.phase(id));
    }
}

void Timeline::capture(const World& world) {
    // A phase that begin() has taken comes once more: of phases with one start, the last one holds.
    for (const PhaseBegun& begun : world.phasesBegun()) {
        if (Track* track = trackOf(world, begun.body)) {
            track->phases_.push_back(begun.phase);
        }
    }
    events_.insert(events_.end(), world.events().begin(), world.events().end());
    end_ = world.time();
}

} // namespace elastoon
