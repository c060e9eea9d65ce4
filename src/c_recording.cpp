// The C interface to recordings. See elastoon.h.
#include "c_interface.h"

#include <memory>
#include <string>

using namespace elastoon;
using namespace elastoon::c_interface;

namespace {

struct HeldRecording {
    Recording recording;
    ElastoonWorld world{}; ///< that it is, or was, recorded from

    HeldRecording() = default;
    HeldRecording(const HeldRecording&) = delete;
    HeldRecording& operator=(const HeldRecording&) = delete;
    ~HeldRecording() {
        if (HeldWorld* live = liveWorld()) {
            live->recording = nullptr;
        }
    }
    /// The world that it takes from; null where it takes from none.
    [[nodiscard]] HeldWorld* liveWorld() const {
        HeldWorld* held = c_interface::find(world);
        return held != nullptr && held->recording == &recording ? held : nullptr;
    }
};

Table<HeldRecording>& recordings() {
    static Table<HeldRecording>* const kTable = new Table<HeldRecording>();
    return *kTable;
}

HeldRecording* find(ElastoonRecording id) {
    return recordings().find({id.slot, id.generation});
}

ElastoonResult giveId(std::unique_ptr<HeldRecording> made, ElastoonRecording* out_recording) {
    const auto key = recordings().add(std::move(made));
    if (key.slot == 0) {
        return refuse(kElastoonRefused, "there are too many recordings; destroy those that are not needed");
    }
    *out_recording = {key.slot, key.generation};
    return kElastoonOk;
}

/// Gives the recording and the world to the call, where there are both and the world may be made another one.
template <class Call>
ElastoonResult onto(ElastoonRecording recording, ElastoonWorld world, Call&& call) {
    return guarded([&] {
        const HeldRecording* held = find(recording);
        if (held == nullptr) {
            return badId("recording");
        }
        HeldWorld* held_world = c_interface::find(world);
        if (held_world == nullptr) {
            return badId("world");
        }
        const ElastoonResult recorded = checkUnrecorded(*held_world);
        return recorded == kElastoonOk ? call(held->recording, *held_world) : recorded;
    });
}

ElastoonResult checkStep(std::size_t step, const Recording& recording, const char* name) {
    return step <= recording.steps.size()
               ? kElastoonOk
               : refuse(kElastoonBadArgument,
                        "must be at most " + std::to_string(recording.steps.size()) + ", the recording's steps", name);
}

} // namespace

Status HeldWorld::change(const Input& input) {
    const Status status =
        apply(input, std::holds_alternative<input::RemoveBody>(input) ? changingBodies() : changing());
    if (status) {
        keep(input);
    }
    return status;
}

void HeldWorld::keep(const Input& input) {
    if (recording != nullptr) {
        recording->inputs.push_back({recording->steps.size(), input});
    }
}

void HeldWorld::step(double dt) {
    changing().step(dt);
    if (recording != nullptr) {
        recording->steps.push_back(dt);
    }
}

ElastoonResult c_interface::checkUnrecorded(const HeldWorld& held) {
    return held.recording == nullptr
               ? kElastoonOk
               : refuse(kElastoonRefused,
                        "is being recorded: elastoonRecordingRewind() takes both back; or destroy the recording first",
                        "world");
}

ElastoonResult elastoonRecordingBegin(ElastoonWorld world, ElastoonRecording* out_recording) {
    return guarded([&] {
        HeldWorld* held = c_interface::find(world);
        if (held == nullptr) {
            return badId("world");
        }
        if (out_recording == nullptr) {
            return nullPointer("out_recording");
        }
        if (const ElastoonResult recorded = checkUnrecorded(*held); recorded != kElastoonOk) {
            return recorded;
        }
        auto made = std::make_unique<HeldRecording>();
        made->world = world;
        held->world.snapshotInto(made->recording.start, {.include_shapes = true});
        Recording* recording = &made->recording;
        const ElastoonResult given = giveId(std::move(made), out_recording);
        if (given == kElastoonOk) {
            held->recording = recording;
        }
        return given;
    });
}

ElastoonResult elastoonRecordingRead(const void* bytes, size_t size, ElastoonRecording* out_recording) {
    return guarded([&] {
        if (bytes == nullptr || out_recording == nullptr) {
            return nullPointer("bytes and out_recording");
        }
        auto read = Recording::fromBytes({static_cast<const std::byte*>(bytes), size});
        if (!read) {
            return refuse(kElastoonBadData, read.error());
        }
        auto made = std::make_unique<HeldRecording>();
        made->recording = std::move(read).value();
        return giveId(std::move(made), out_recording);
    });
}

ElastoonResult elastoonRecordingDestroy(ElastoonRecording recording) {
    return recordings().remove({recording.slot, recording.generation}) != nullptr ? kElastoonOk : badId("recording");
}

bool elastoonRecordingIsValid(ElastoonRecording recording) {
    return find(recording) != nullptr;
}

ElastoonResult elastoonRecordingInfo(ElastoonRecording recording, ElastoonRecordingInfo* out_info) {
    const HeldRecording* held = find(recording);
    if (held == nullptr) {
        return badId("recording");
    }
    if (out_info == nullptr) {
        return nullPointer("out_info");
    }
    *out_info = {held->recording.steps.size(), held->recording.inputs.size(), held->liveWorld() != nullptr};
    return kElastoonOk;
}

ElastoonResult elastoonRecordingBytes(ElastoonRecording recording, void* out_bytes, size_t capacity, size_t* out_size) {
    return guarded([&] {
        const HeldRecording* held = find(recording);
        if (held == nullptr) {
            return badId("recording");
        }
        const std::vector<std::byte> bytes = held->recording.toBytes();
        return writeList(bytes.size(), static_cast<std::byte*>(out_bytes), capacity, out_size,
                         [&](std::size_t i) { return bytes[i]; });
    });
}

ElastoonResult elastoonRecordingStart(ElastoonRecording recording, ElastoonWorld world) {
    return onto(recording, world, [](const Recording& from, HeldWorld& to) { return restore(to, from.start); });
}

ElastoonResult elastoonRecordingReplay(ElastoonRecording recording, ElastoonWorld world, size_t from, size_t to) {
    return onto(recording, world, [&](const Recording& source, HeldWorld& held) {
        if (const ElastoonResult flaw = checkStep(from, source, "from"); flaw != kElastoonOk) {
            return flaw;
        }
        const Status status = replay(source, held.changingBodies(), from, to);
        return status ? kElastoonOk : refuse(kElastoonRefused, status.error());
    });
}

ElastoonResult elastoonRecordingRewind(ElastoonRecording recording, size_t step, const void* bytes, size_t size) {
    return guarded([&] {
        HeldRecording* held = find(recording);
        if (held == nullptr) {
            return badId("recording");
        }
        if (bytes == nullptr) {
            return nullPointer("bytes");
        }
        HeldWorld* world = held->liveWorld();
        if (world == nullptr) {
            return refuse(kElastoonRefused, "takes from no world: it was read from bytes, or its world is gone",
                          "recording");
        }
        if (const ElastoonResult flaw = checkStep(step, held->recording, "step"); flaw != kElastoonOk) {
            return flaw;
        }
        const ElastoonResult restored = restore(*world, {static_cast<const std::byte*>(bytes), size});
        if (restored == kElastoonOk) {
            held->recording.cut(step);
        }
        return restored;
    });
}
