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
        keep(*trackOf(world, id), world.phase(id), 0);
    }
}

void Timeline::capture(const World& world) {
    // A phase that begin() has taken comes once more: of phases with one start, the last one holds.
    for (const PhaseBegun& begun : world.phasesBegun()) {
        if (Track* track = trackOf(world, begun.body)) {
            keep(*track, begun.phase, moments_.size() + 1);
        }
    }
    events_.insert(events_.end(), world.events().begin(), world.events().end());
    end_ = world.time();
    moments_.push_back({end_, events_.size()});
}

void Timeline::keep(Track& track, const Phase& phase, std::size_t capture) {
    track.phases_.push_back(phase);
    track.captured_.push_back(capture);
}

void Timeline::cut(std::size_t captures) {
    if (captures >= moments_.size()) {
        return;
    }
    moments_.resize(captures);
    events_.resize(captures == 0 ? 0 : moments_.back().events);
    end_ = captures == 0 ? start_ : moments_.back().time;
    for (Track& track : tracks_) {
        while (!track.captured_.empty() && track.captured_.back() > captures) {
            track.captured_.pop_back();
            track.phases_.pop_back();
        }
    }
    // Tracks stand in the order in which they came: those without a phase are the last ones.
    while (!tracks_.empty() && tracks_.back().phases_.empty()) {
        tracks_.pop_back();
    }
    std::fill(track_of_slot_.begin(), track_of_slot_.end(), std::size_t{0});
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
        track_of_slot_[tracks_[i].body().slot] = i + 1;
    }
}

} // namespace elastoon
