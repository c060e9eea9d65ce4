// The C interface to timelines. See elastoon.h.
#include "elastoon/timeline.h"

#include "c_interface.h"

#include <algorithm>
#include <memory>

using namespace elastoon;
using namespace elastoon::c_interface;

namespace {

struct HeldTimeline {
    Timeline timeline;
    ElastoonWorld world{};
    std::vector<ElastoonEvent> events;
};

Table<HeldTimeline>& timelines() {
    static Table<HeldTimeline>* const kTable = new Table<HeldTimeline>();
    return *kTable;
}

HeldTimeline* find(ElastoonTimeline id) {
    return timelines().find({id.slot, id.generation});
}

/// The newest track of the body's slot that is the body's.
const Track* trackOf(const HeldTimeline& held, ElastoonBody body) {
    if (body.world.slot != held.world.slot || body.world.generation != held.world.generation) {
        return nullptr;
    }
    const auto& tracks = held.timeline.tracks();
    const auto found =
        std::find_if(tracks.rbegin(), tracks.rend(), [&](const Track& track) { return track.body() == from(body); });
    return found == tracks.rend() ? nullptr : &*found;
}

void writeMatrix(const Pose& pose, float* out) {
    const Mat3 linear = linearOf(pose);
    for (int column = 0; column < 4; ++column) {
        const Vec3& from_column = column < 3 ? linear[column] : pose.position;
        for (int row = 0; row < 3; ++row) {
            *out++ = static_cast<float>(from_column[row]);
        }
    }
}

} // namespace

ElastoonResult elastoonTimelineBegin(ElastoonWorld world, ElastoonTimeline* out_timeline) {
    return guarded([&] {
        HeldWorld* held = c_interface::find(world);
        if (held == nullptr) {
            return badId("world");
        }
        if (out_timeline == nullptr) {
            return nullPointer("out_timeline");
        }
        auto made = std::make_unique<HeldTimeline>();
        made->world = world;
        made->timeline.begin(held->world);
        const auto key = timelines().add(std::move(made));
        if (key.slot == 0) {
            return refuse(kElastoonRefused, "there are too many timelines; destroy those that are not needed");
        }
        *out_timeline = {key.slot, key.generation};
        return kElastoonOk;
    });
}

ElastoonResult elastoonTimelineCapture(ElastoonTimeline timeline) {
    return guarded([&] {
        HeldTimeline* held = find(timeline);
        if (held == nullptr) {
            return badId("timeline");
        }
        const HeldWorld* world = c_interface::find(held->world);
        if (world == nullptr) {
            return badId("world of the timeline");
        }
        held->timeline.capture(world->world);
        return kElastoonOk;
    });
}

ElastoonResult elastoonTimelineCut(ElastoonTimeline timeline, size_t captures) {
    return guarded([&] {
        HeldTimeline* held = find(timeline);
        if (held == nullptr) {
            return badId("timeline");
        }
        held->timeline.cut(captures);
        held->events.resize(std::min(held->events.size(), held->timeline.events().size()));
        return kElastoonOk;
    });
}

ElastoonResult elastoonTimelineDestroy(ElastoonTimeline timeline) {
    return timelines().remove({timeline.slot, timeline.generation}) != nullptr ? kElastoonOk : badId("timeline");
}

bool elastoonTimelineIsValid(ElastoonTimeline timeline) {
    return find(timeline) != nullptr;
}

ElastoonResult elastoonTimelineInfo(ElastoonTimeline timeline, ElastoonTimelineInfo* out_info) {
    const HeldTimeline* held = find(timeline);
    if (held == nullptr) {
        return badId("timeline");
    }
    if (out_info == nullptr) {
        return nullPointer("out_info");
    }
    *out_info = {held->timeline.start(), held->timeline.end(), held->timeline.captures()};
    return kElastoonOk;
}

ElastoonResult elastoonTimelineMatrices(ElastoonTimeline timeline, double time, float* out_matrices, size_t capacity,
                                        size_t* out_count) {
    const HeldTimeline* held = find(timeline);
    if (held == nullptr) {
        return badId("timeline");
    }
    if (out_count == nullptr) {
        return nullPointer("the count");
    }
    if (!std::isfinite(time)) {
        return refuse(kElastoonBadArgument, "must be a finite number", "time");
    }
    std::size_t slots = 0;
    for (const Track& track : held->timeline.tracks()) {
        slots = std::max<std::size_t>(slots, track.body().slot);
    }
    *out_count = slots;
    if (out_matrices == nullptr) {
        return capacity == 0 ? kElastoonOk : nullPointer("the array");
    }
    if (capacity < slots) {
        return refuse(kElastoonTooSmall, "the array is too small; the count tells what is needed");
    }
    std::fill_n(out_matrices, 12 * slots, 0.0F);
    const double start = held->timeline.start();
    for (const Track& track : held->timeline.tracks()) {
        if (const double begun = track.phases().front().start; begun <= time || begun <= start) {
            writeMatrix(track.poseAt(time), out_matrices + std::size_t{12} * (track.body().slot - 1));
        }
    }
    return kElastoonOk;
}

ElastoonResult elastoonTimelinePoses(ElastoonTimeline timeline, ElastoonBody body, const double* times, size_t count,
                                     ElastoonPose* out_poses, ElastoonVec3* out_velocities) {
    const HeldTimeline* held = find(timeline);
    if (held == nullptr) {
        return badId("timeline");
    }
    const Track* track = trackOf(*held, body);
    if (track == nullptr) {
        return badId("body");
    }
    if (times == nullptr && count > 0) {
        return nullPointer("times");
    }
    if (std::any_of(times, times + count, [](double time) { return !std::isfinite(time); })) {
        return refuse(kElastoonBadArgument, "must be finite numbers", "times");
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (out_poses != nullptr) {
            out_poses[i] = toC(track->poseAt(times[i]));
        }
        if (out_velocities != nullptr) {
            out_velocities[i] = toC(track->velocityAt(times[i]));
        }
    }
    return kElastoonOk;
}

ElastoonResult elastoonTimelineEvents(ElastoonTimeline timeline, const ElastoonEvent** out_events, size_t* out_count) {
    return guarded([&] {
        HeldTimeline* held = find(timeline);
        if (held == nullptr) {
            return badId("timeline");
        }
        if (out_events == nullptr || out_count == nullptr) {
            return nullPointer("out_events and out_count");
        }
        const auto& events = held->timeline.events();
        for (std::size_t i = held->events.size(); i < events.size(); ++i) {
            held->events.push_back(toC(events[i], held->world));
        }
        *out_events = held->events.data();
        *out_count = held->events.size();
        return kElastoonOk;
    });
}
