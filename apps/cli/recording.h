// What a scene did, as tables: poses and events in CSV, both in one JSON file. Others script against them.
#pragma once

#include "elastoon/scene.h"
#include "elastoon/timeline.h"

#include <string>
#include <vector>

namespace elastoon {

/// The times of the frames, k / fps from 0 to the duration.
[[nodiscard]] Result<std::vector<double>> frameTimes(double fps, double duration);

/// The track of each body, in the scene's order.
[[nodiscard]] Result<std::vector<const Track*>> tracksOf(const StagedScene& staged, const Timeline& timeline);

/// The shortest text that reads back as the same number.
[[nodiscard]] std::string shortestNumber(double value);

/// One row for each frame and body, by time, then by body: time,body,phase,px,py,pz,qx,qy,qz,qw,stretch,vx,vy,vz.
Status writePoseCsv(const Scene& scene, const StagedScene& staged, const Timeline& timeline, double fps,
                    double duration, const std::string& path);

/// One row for each event: time,type,body,other,px,py,pz,nx,ny,nz,speed,s_in,s_mid,s_out,t_in,t_out.
Status writeEventCsv(const Scene& scene, const StagedScene& staged, const Timeline& timeline, const std::string& path);

/// Poses and events in one file: {"elastoon": 1, "kind": "recording", "scene", "fps", "duration", "gravity",
/// "bodies": [{"name", "shape", "frames": [[px,py,pz,qx,qy,qz,qw,stretch], ...]}], "events": [{as the CSV's columns}]}.
Status writeRecordingJson(const Scene& scene, const StagedScene& staged, const Timeline& timeline, double fps,
                          double duration, const std::string& path);

} // namespace elastoon
