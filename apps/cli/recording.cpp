// See recording.h.
#include "recording.h"

#include "output_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <map>

namespace elastoon {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kMostFrames = 1e8;
constexpr std::array<const char*, 12> kEventNumbers{"px",    "py",   "pz",    "nx",    "ny",   "nz",
                                                    "speed", "s_in", "s_mid", "s_out", "t_in", "t_out"};

std::array<double, 12> numbersOf(const Event& event) {
    return {event.point.x, event.point.y, event.point.z, event.normal.x, event.normal.y, event.normal.z,
            event.speed,   event.s_in,    event.s_mid,   event.s_out,    event.t_in,     event.t_out};
}

std::array<double, 8> numbersOf(const Pose& pose) {
    const Vec3& p = pose.position;
    const Quat& q = pose.orientation;
    return {p.x, p.y, p.z, q.x, q.y, q.z, q.w, pose.stretch};
}

void appendNumber(std::string& text, double value) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    text.append(digits.data(), end);
}

template <std::size_t count>
void appendCells(std::string& text, const std::array<double, count>& values) {
    for (const double value : values) {
        text += ',';
        appendNumber(text, value);
    }
}

/// A name as a CSV cell: quoted where it holds a comma, a quote or a line end (RFC 4180).
std::string cell(const std::string& name) {
    if (name.find_first_of(",\"\r\n") == std::string::npos) {
        return name;
    }
    std::string quoted = "\"";
    for (const char c : name) {
        quoted += c == '"' ? "\"\"" : std::string(1, c);
    }
    return quoted + '"';
}

/// The scene's names by the ids that events hold.
struct Names {
    std::map<BodyId, std::string> bodies;
    std::map<ObstacleId, std::string> obstacles;

    Names(const Scene& scene, const StagedScene& staged) {
        for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
            bodies[staged.bodies[i]] = scene.bodies[i].name;
        }
        for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
            obstacles[staged.obstacles[i]] = scene.obstacles[i].name;
        }
    }
    /// Empty for what is not of the scene, as the other of a wake without support.
    template <class Id>
    static const std::string& of(const std::map<Id, std::string>& names, Id id) {
        static const std::string kNone;
        const auto found = names.find(id);
        return found == names.end() ? kNone : found->second;
    }
};

/// Frames and tracks of a recording, or why there are none.
struct Recording {
    std::vector<double> times;
    std::vector<const Track*> tracks;
};

Result<Recording> prepared(const StagedScene& staged, const Timeline& timeline, double fps, double duration) {
    auto times = frameTimes(fps, duration);
    if (!times) {
        return times.error();
    }
    auto tracks = tracksOf(staged, timeline);
    if (!tracks) {
        return tracks.error();
    }
    return Recording{std::move(times).value(), std::move(tracks).value()};
}

Json eventJson(const Event& event, const Names& names) {
    Json json;
    json["time"] = event.time;
    json["type"] = nameOf(event.type);
    json["body"] = Names::of(names.bodies, event.body);
    json["other"] = Names::of(names.obstacles, event.other);
    const auto numbers = numbersOf(event);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        json[kEventNumbers[i]] = numbers[i];
    }
    return json;
}

} // namespace

std::string shortestNumber(double value) {
    std::string text;
    appendNumber(text, value);
    return text;
}

Result<std::vector<double>> frameTimes(double fps, double duration) {
    if (!std::isfinite(fps) || fps <= 0.0) {
        return Error{fmt::format("{} frames per second; a number above 0 is needed", fps), "fps"};
    }
    if (!std::isfinite(duration) || duration < 0.0) {
        return Error{fmt::format("{} s; a number of 0 or more is needed", duration), "duration"};
    }
    const double last = std::floor(duration * fps + 1e-9);
    if (last >= kMostFrames) {
        return Error{fmt::format("{:.3g} frames are too many; shorten the duration or lower the rate", last), "fps"};
    }
    std::vector<double> times;
    for (double k = 0.0; k <= last; k += 1.0) {
        times.push_back(k / fps);
    }
    return times;
}

Result<std::vector<const Track*>> tracksOf(const StagedScene& staged, const Timeline& timeline) {
    std::map<BodyId, const Track*> by_id;
    for (const Track& track : timeline.tracks()) {
        by_id[track.body()] = &track;
    }
    std::vector<const Track*> tracks;
    for (std::size_t i = 0; i < staged.bodies.size(); ++i) {
        const auto found = by_id.find(staged.bodies[i]);
        if (found == by_id.end()) {
            return Error{"the timeline does not hold this body; begin it before the first step",
                         fmt::format("bodies[{}]", i)};
        }
        tracks.push_back(found->second);
    }
    return tracks;
}

Status writePoseCsv(const Scene& scene, const StagedScene& staged, const Timeline& timeline, double fps,
                    double duration, const std::string& path) {
    const auto recording = prepared(staged, timeline, fps, duration);
    if (!recording) {
        return recording.error();
    }
    std::vector<std::string> names;
    for (const SceneBody& body : scene.bodies) {
        names.push_back(cell(body.name));
    }
    std::string text = "time,body,phase,px,py,pz,qx,qy,qz,qw,stretch,vx,vy,vz\n";
    for (const double time : recording.value().times) {
        for (std::size_t i = 0; i < names.size(); ++i) {
            const Track& track = *recording.value().tracks[i];
            appendNumber(text, time);
            text += ',';
            text += names[i];
            text += ',';
            text += nameOf(track.phaseAt(time));
            appendCells(text, numbersOf(track.poseAt(time)));
            const Vec3 velocity = track.velocityAt(time);
            appendCells(text, std::array{velocity.x, velocity.y, velocity.z});
            text += '\n';
        }
    }
    return writeWhole(path, text);
}

Status writeEventCsv(const Scene& scene, const StagedScene& staged, const Timeline& timeline, const std::string& path) {
    const Names names(scene, staged);
    std::string text = "time,type,body,other,px,py,pz,nx,ny,nz,speed,s_in,s_mid,s_out,t_in,t_out\n";
    for (const Event& event : timeline.events()) {
        appendNumber(text, event.time);
        text += ',';
        text += nameOf(event.type);
        text += ',' + cell(Names::of(names.bodies, event.body));
        text += ',' + cell(Names::of(names.obstacles, event.other));
        appendCells(text, numbersOf(event));
        text += '\n';
    }
    return writeWhole(path, text);
}

Status writeRecordingJson(const Scene& scene, const StagedScene& staged, const Timeline& timeline, double fps,
                          double duration, const std::string& path) {
    const auto recording = prepared(staged, timeline, fps, duration);
    if (!recording) {
        return recording.error();
    }
    const Vec3& gravity = scene.gravity;
    Json json{{"elastoon", 1}, {"kind", "recording"},  {"scene", scene.name},
              {"fps", fps},    {"duration", duration}, {"gravity", {gravity.x, gravity.y, gravity.z}}};
    json["bodies"] = Json::array();
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        Json frames = Json::array();
        for (const double time : recording.value().times) {
            frames.push_back(numbersOf(recording.value().tracks[i]->poseAt(time)));
        }
        const SceneBody& body = scene.bodies[i];
        json["bodies"].push_back(
            {{"name", body.name}, {"shape", scene.shapes[body.shape].name}, {"frames", std::move(frames)}});
    }
    const Names names(scene, staged);
    json["events"] = Json::array();
    for (const Event& event : timeline.events()) {
        json["events"].push_back(eventJson(event, names));
    }
    return writeWhole(path, json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
}

} // namespace elastoon
