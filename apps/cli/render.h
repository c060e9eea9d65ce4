// Pictures and videos of a performed scene.
#pragma once

#include "picture.h"

#include "elastoon/scene.h"
#include "elastoon/timeline.h"

#include <string>
#include <vector>

namespace elastoon {

struct PictureOptions {
    PictureSize size{1280, 720};
    int samples = 32; ///< most rays for a pixel
    int threads = 0;  ///< 0: all processors; the picture does not depend on it
};

struct StrobeOptions : PictureOptions {
    std::vector<double> times; ///< of the ghosts, s; empty: as the scene's strobe says
};

struct VideoOptions : PictureOptions {
    double fps = 30.0;
    int first_frame = 0;   ///< frame k shows time k / fps
    int end_frame = -1;    ///< one past the last; negative: to the end of the timeline
    double shutter = 0.0;  ///< share of a frame's time that motion is blurred over; 0: none
};

/// What was written.
struct Rendered {
    PictureSize size;
    int moments = 0; ///< ghosts or frames
};

/// Obstacles that move are drawn where they are at the last ghost. All three draw a progress bar and stop with an error
/// when interrupted(); the file then is as before.
Result<Rendered> renderStrobe(const Scene& scene, const Timeline& timeline, const StrobeOptions& options,
                              const std::string& path);
/// One moment as a .png.
Result<Rendered> renderStill(const Scene& scene, const Timeline& timeline, double time, const PictureOptions& options,
                             const std::string& path);
/// A video, its kind by the ending of the path.
Result<Rendered> renderVideo(const Scene& scene, const Timeline& timeline, const VideoOptions& options,
                             const std::string& path);

/// How many frames of this rate begin in 0..duration.
[[nodiscard]] int frameCount(double duration, double fps);

} // namespace elastoon
