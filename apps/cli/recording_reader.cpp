// See recording_reader.h.
#include "recording_reader.h"

#include "recording.h"
#include "video.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>

namespace elastoon {

namespace {

using Json = nlohmann::json;
using Cells = std::vector<std::string>;

constexpr std::string_view kPoseHeader = "time,body,phase,px,py,pz,qx,qy,qz,qw,stretch,vx,vy,vz";
constexpr std::string_view kEventHeader = "time,type,body,other,px,py,pz,nx,ny,nz,speed,s_in,s_mid,s_out,t_in,t_out";
constexpr std::size_t kRecordedNumbers = 8; // of a pose in a recording: without the velocity

struct CsvRow {
    std::size_t line = 1;
    Cells cells;
};

/// Rows of cells (RFC 4180); none where the text breaks off within one.
std::optional<std::vector<CsvRow>> rowsOf(std::string_view text) {
    std::vector<CsvRow> rows;
    CsvRow row{1, {""}};
    std::size_t line = 1;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        line += c == '\n' ? 1 : 0;
        if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
            row.cells.back() += text[++i];
        } else if (c == '"') {
            quoted = !quoted;
        } else if (!quoted && c == ',') {
            row.cells.emplace_back();
        } else if (!quoted && c == '\n') {
            rows.push_back(std::move(row));
            row = {line, {""}};
        } else {
            row.cells.back() += c;
        }
    }
    const bool whole = !quoted && row.cells == Cells{""};
    return whole ? std::optional(std::move(rows)) : std::nullopt;
}

Cells namesIn(std::string_view header) {
    return rowsOf(std::string(header) + "\n")->front().cells;
}

std::optional<double> numberIn(const std::string& cell) {
    double value = 0.0;
    const char* end = cell.data() + cell.size();
    const auto [rest, error] = std::from_chars(cell.data(), end, value);
    return error == std::errc() && rest == end && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

Result<std::vector<double>> numbersIn(const CsvRow& row, const Cells& header, std::size_t first,
                                      const std::string& path) {
    std::vector<double> numbers;
    for (std::size_t i = first; i < row.cells.size(); ++i) {
        const auto number = numberIn(row.cells[i]);
        if (!number) {
            return Error{fmt::format("{} is \"{}\", which is no number", header[i], row.cells[i]),
                         fmt::format("{}:{}", path, row.line)};
        }
        numbers.push_back(*number);
    }
    return numbers;
}

/// Bodies stand in the same order in every frame; the first frame tells which there are.
Status addPoseRow(RecordedRun& run, const CsvRow& row, double time, PoseRow pose, const std::string& path) {
    const std::string& body = row.cells[1];
    const bool begins = run.times.empty() || (run.times.size() == 1 && time == run.times.front());
    const std::size_t at = begins ? run.bodies.size() : run.poses.size() % run.bodies.size();
    if (begins) {
        run.bodies.push_back(body);
    }
    const bool in_place = run.bodies[at] == body && (at == 0) == (run.times.empty() || time > run.times.back()) &&
                          (at == 0 || time == run.times.back());
    if (!in_place) {
        return Error{fmt::format("body \"{}\" at {} s is not where the first frame has it", body, shortestNumber(time)),
                     fmt::format("{}:{}", path, row.line)};
    }
    if (at == 0) {
        run.times.push_back(time);
    }
    run.poses.push_back(std::move(pose));
    return success();
}

Result<RecordedRun> readCsv(const std::string& text, const std::string& path) {
    const auto rows = rowsOf(text);
    const std::string header = text.substr(0, text.find('\n'));
    RecordedRun run;
    run.kind = header == kPoseHeader ? RecordedRun::Kind::Poses : RecordedRun::Kind::Events;
    if (header != kPoseHeader && header != kEventHeader) {
        return Error{"is neither a pose table nor an event table of elastoon simulate", path};
    }
    if (!rows) {
        return Error{"is cut off: its last line has no end", path};
    }
    const Cells names = namesIn(header);
    const std::size_t first_number = run.kind == RecordedRun::Kind::Poses ? 3 : 4;
    if (run.kind == RecordedRun::Kind::Poses) {
        run.pose_fields.assign(names.begin() + 3, names.end());
    }
    for (std::size_t i = 1; i < rows->size(); ++i) {
        const CsvRow& row = (*rows)[i];
        const std::string place = fmt::format("{}:{}", path, row.line);
        const auto time = numberIn(row.cells.front());
        if (row.cells.size() != names.size() || !time) {
            return Error{fmt::format("needs {} cells, of which the first is a time", names.size()), place};
        }
        auto numbers = numbersIn(row, names, first_number, path);
        if (!numbers) {
            return numbers.error();
        }
        if (run.kind == RecordedRun::Kind::Events) {
            run.events.push_back({*time, row.cells[1], row.cells[2], row.cells[3], std::move(numbers).value()});
        } else if (auto status = addPoseRow(run, row, *time, {row.cells[2], std::move(numbers).value()}, path);
                   !status) {
            return status.error();
        }
    }
    if (run.kind == RecordedRun::Kind::Poses && run.poses.size() != run.times.size() * run.bodies.size()) {
        return Error{"is cut off: its last frame does not hold every body", path};
    }
    return run;
}

/// nlohmann's messages begin with the name of its exception.
std::string plain(std::string_view message) {
    const std::size_t end = message.starts_with("[") ? message.find("] ") : std::string_view::npos;
    return std::string(end == std::string_view::npos ? message : message.substr(end + 2));
}

/// The times that the rate and the duration say, if the first body has about as many frames: damaged numbers must not
/// ask for more memory than the file is worth.
Status takeTimes(const Json& json, RecordedRun& run, const std::string& path) {
    const Json& bodies = json.at("bodies");
    if (bodies.empty()) {
        return success();
    }
    const std::size_t frames = bodies.at(0).at("frames").size();
    if (run.fps * run.duration > static_cast<double>(frames)) {
        return Error{fmt::format("has {} frames, too few for {} s at {} a second", frames, shortestNumber(run.duration),
                                 shortestNumber(run.fps)),
                     path};
    }
    auto times = frameTimes(run.fps, run.duration);
    if (!times) {
        return Error{times.error().text(), path};
    }
    run.times = std::move(times).value();
    return success();
}

Status takeBodies(const Json& json, RecordedRun& run, const std::string& path) {
    const Json& bodies = json.at("bodies");
    run.poses.resize(run.times.size() * bodies.size());
    for (std::size_t body = 0; body < bodies.size(); ++body) {
        run.bodies.push_back(bodies[body].at("name").get<std::string>());
        run.shapes.push_back(bodies[body].at("shape").get<std::string>());
        const auto frames = bodies[body].at("frames").get<std::vector<std::vector<double>>>();
        if (frames.size() != run.times.size()) {
            return Error{fmt::format("body \"{}\" has {} frames; {} s at {} a second are {}", run.bodies.back(),
                                     frames.size(), shortestNumber(run.duration), shortestNumber(run.fps),
                                     run.times.size()),
                         path};
        }
        for (std::size_t frame = 0; frame < frames.size(); ++frame) {
            if (frames[frame].size() != kRecordedNumbers) {
                return Error{fmt::format("frame {} of body \"{}\" has {} numbers; {} are needed", frame,
                                         run.bodies.back(), frames[frame].size(), kRecordedNumbers),
                             path};
            }
            run.poses[frame * bodies.size() + body].numbers = frames[frame];
        }
    }
    return success();
}

void takeEvents(const Json& json, RecordedRun& run) {
    for (const Json& event : json.at("events")) {
        EventRow row{event.at("time").get<double>(),
                     event.at("type").get<std::string>(),
                     event.at("body").get<std::string>(),
                     event.at("other").get<std::string>(),
                     {}};
        for (const std::string& field : eventFields()) {
            row.numbers.push_back(event.at(field).get<double>());
        }
        run.events.push_back(std::move(row));
    }
}

Result<RecordedRun> readJson(const std::string& text, const std::string& path) {
    try {
        const Json json = Json::parse(text);
        if (!json.is_object() || json.value("kind", Json()) != "recording") {
            return Error{"is no recording of elastoon simulate", path};
        }
        RecordedRun run;
        run.fps = json.at("fps").get<double>();
        run.duration = json.at("duration").get<double>();
        if (auto status = takeTimes(json, run, path); !status) {
            return status.error();
        }
        const Cells names = namesIn(kPoseHeader);
        run.pose_fields.assign(names.begin() + 3, names.begin() + 3 + kRecordedNumbers);
        if (auto status = takeBodies(json, run, path); !status) {
            return status.error();
        }
        takeEvents(json, run);
        return run;
    } catch (const Json::exception& error) {
        return Error{"is damaged: " + plain(error.what()), path};
    }
}

} // namespace

const std::vector<std::string>& eventFields() {
    static const Cells kFields = [] {
        const Cells names = namesIn(kEventHeader);
        return Cells(names.begin() + 4, names.end());
    }();
    return kFields;
}

Result<RecordedRun> readRun(const std::string& path) {
    const std::string ending = endingOf(path);
    if (ending != ".json" && ending != ".csv") {
        return Error{"the ending must be .json or .csv", path};
    }
    std::error_code ignored;
    std::ifstream stream(path, std::ios::binary);
    if (!stream.is_open() || std::filesystem::is_directory(path, ignored)) {
        return Error{"cannot be read", path};
    }
    std::ostringstream content;
    content << stream.rdbuf();
    const std::string text = std::move(content).str();
    return ending == ".json" ? readJson(text, path) : readCsv(text, path);
}

} // namespace elastoon
