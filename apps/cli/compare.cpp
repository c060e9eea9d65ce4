// See compare.h.
#include "compare.h"

#include "recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace elastoon {

namespace {

std::string listOf(const std::vector<std::string>& names) {
    return fmt::format("{}", fmt::join(names, ", "));
}

/// Why the runs cannot be compared, or nothing.
std::optional<Error> unlikeness(const RecordedRun& a, const RecordedRun& b) {
    const auto differ = [](const char* what, const auto& first, const auto& second) {
        return Error{fmt::format("the runs have other {}: {} and {}", what, first, second), ""};
    };
    if (a.kind != b.kind) {
        return Error{"the files are of two kinds: compare recordings with recordings, tables with their like", ""};
    }
    if (a.fps != b.fps) {
        return differ("rates (fps)", shortestNumber(a.fps), shortestNumber(b.fps));
    }
    if (a.duration != b.duration) {
        return differ("durations", shortestNumber(a.duration), shortestNumber(b.duration));
    }
    if (a.bodies != b.bodies) {
        return differ("bodies", listOf(a.bodies), listOf(b.bodies));
    }
    if (a.shapes != b.shapes) {
        return differ("shapes", listOf(a.shapes), listOf(b.shapes));
    }
    if (a.times != b.times) {
        return Error{fmt::format("the runs have other times: {} and {} frames, by another rate or duration",
                                 a.times.size(), b.times.size()),
                     ""};
    }
    return std::nullopt;
}

void setNumbers(Difference& difference, const std::string& field, double a, double b) {
    difference.field = field;
    difference.first = shortestNumber(a);
    difference.second = shortestNumber(b);
    difference.by = std::fabs(a - b);
}

void setTexts(Difference& difference, const char* field, const std::string& a, const std::string& b) {
    difference.field = field;
    difference.first = a;
    difference.second = b;
}

/// The first field in which two rows differ; false: they are equal.
bool differ(Difference& difference, const std::vector<std::string>& fields, const std::vector<double>& a,
            const std::vector<double>& b) {
    for (std::size_t i = 0; i < fields.size(); ++i) {
        if (a[i] != b[i]) {
            setNumbers(difference, fields[i], a[i], b[i]);
            return true;
        }
    }
    return false;
}

std::optional<Difference> comparePoses(const RecordedRun& a, const RecordedRun& b) {
    for (std::size_t i = 0; i < a.poses.size(); ++i) {
        const std::size_t frame = i / a.bodies.size();
        Difference difference;
        difference.time = a.times[frame];
        difference.where = fmt::format("frame {}", frame);
        difference.body = a.bodies[i % a.bodies.size()];
        if (a.poses[i].phase != b.poses[i].phase) {
            setTexts(difference, "phase", a.poses[i].phase, b.poses[i].phase);
            return difference;
        }
        if (differ(difference, a.pose_fields, a.poses[i].numbers, b.poses[i].numbers)) {
            return difference;
        }
    }
    return std::nullopt;
}

bool differ(Difference& difference, const EventRow& a, const EventRow& b) {
    if (a.body != b.body) {
        setTexts(difference, "body", a.body, b.body);
    } else if (a.type != b.type) {
        setTexts(difference, "type", a.type, b.type);
    } else if (a.time != b.time) {
        setNumbers(difference, "time", a.time, b.time);
    } else if (a.other != b.other) {
        setTexts(difference, "other", a.other, b.other);
    } else {
        return differ(difference, eventFields(), a.numbers, b.numbers);
    }
    return true;
}

Difference at(const EventRow& event, std::size_t index) {
    Difference difference;
    difference.time = event.time;
    difference.where = fmt::format("event {} ({})", index, event.type);
    difference.body = event.body;
    return difference;
}

std::optional<Difference> compareEvents(const RecordedRun& a, const RecordedRun& b) {
    const std::size_t both = std::min(a.events.size(), b.events.size());
    for (std::size_t i = 0; i < both; ++i) {
        Difference difference = at(a.events[i].time <= b.events[i].time ? a.events[i] : b.events[i], i);
        if (differ(difference, a.events[i], b.events[i])) {
            return difference;
        }
    }
    if (a.events.size() == b.events.size()) {
        return std::nullopt;
    }
    const bool in_first = a.events.size() > both;
    Difference difference = at((in_first ? a : b).events[both], both);
    difference.first = in_first ? "there" : "missing";
    difference.second = in_first ? "missing" : "there";
    return difference;
}

} // namespace

Result<Comparison> compareRuns(const RecordedRun& first, const RecordedRun& second) {
    if (auto error = unlikeness(first, second)) {
        return *error;
    }
    Comparison comparison;
    const auto pose = comparePoses(first, second);
    const auto event = compareEvents(first, second);
    // Of the same time, the event is the cause.
    comparison.earliest = event && (!pose || event->time <= pose->time) ? event : pose;
    for (std::size_t i = 0; i < first.poses.size(); ++i) {
        const std::vector<double>&a = first.poses[i].numbers, &b = second.poses[i].numbers;
        const double apart = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
        if (apart > comparison.furthest) {
            comparison.furthest = apart;
            comparison.furthest_time = first.times[i / first.bodies.size()];
            comparison.furthest_body = first.bodies[i % first.bodies.size()];
        }
    }
    return comparison;
}

} // namespace elastoon
