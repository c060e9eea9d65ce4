// Where two runs of a scene part.
#pragma once

#include "recording_reader.h"

#include <optional>
#include <string>

namespace elastoon {

/// A place where two runs are not the same.
struct Difference {
    double time = 0.0; ///< s
    std::string where; ///< "frame 30" or "event 4 (impact)", counted from 0
    std::string body;
    std::string field; ///< as the files name it; empty where one run has no such event
    std::string first, second; ///< what stands there
    std::optional<double> by; ///< how far two numbers are apart
};

struct Comparison {
    std::optional<Difference> earliest; ///< none: the runs are equal. Zeros are, whatever their sign.
    double furthest = 0.0; ///< how far a body is from itself at most, m
    double furthest_time = 0.0;
    std::string furthest_body;
};

/// Compares numbers exactly. Refused: runs of another kind, rate or duration, or with other bodies.
[[nodiscard]] Result<Comparison> compareRuns(const RecordedRun& first, const RecordedRun& second);

} // namespace elastoon
