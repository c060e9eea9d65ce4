// Reading back what recording.h writes: recordings (.json), pose tables and event tables (.csv).
#pragma once

#include "elastoon/result.h"

#include <string>
#include <vector>

namespace elastoon {

/// A body in a frame.
struct PoseRow {
    std::string phase; ///< empty in a recording
    std::vector<double> numbers; ///< as RecordedRun::pose_fields names them
};

struct EventRow {
    double time = 0.0;
    std::string type, body, other;
    std::vector<double> numbers; ///< as kEventFields names them
};

/// The numbers of an event, in the order of the files.
[[nodiscard]] const std::vector<std::string>& eventFields();

/// What one file holds. Recordings have all of it, the tables their part.
struct RecordedRun {
    enum class Kind { Recording, Poses, Events };
    Kind kind = Kind::Recording;
    double fps = 0.0, duration = 0.0; ///< of a recording
    std::vector<std::string> bodies, shapes; ///< names; shapes: of a recording
    std::vector<double> times;        ///< of the frames, s
    std::vector<std::string> pose_fields;
    std::vector<PoseRow> poses; ///< by frame, then by body: poses[frame * bodies.size() + body]
    std::vector<EventRow> events;
};

/// Reads a file by its ending. Refused, with the place: another ending, damage, numbers that are not finite, frames
/// that do not hold every body.
[[nodiscard]] Result<RecordedRun> readRun(const std::string& path);

} // namespace elastoon
