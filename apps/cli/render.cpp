// See render.h.
#include "render.h"

#include "progress.h"
#include "sampling.h"
#include "show.h"
#include "strobe.h"
#include "video.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace elastoon {

namespace {

Error stopped(const std::string& path) {
    return {"interrupted; nothing was written", path};
}

/// The ghosts in order of time. Times that were asked for one by one are all
/// keys.
std::vector<Ghost> ghostsAt(const Show& show, const Scene& scene, const Timeline& timeline,
                            const std::vector<double>& times, bool all_keys) {
    std::vector<std::vector<Thing>> moments;
    for (const double t : times) {
        moments.push_back(show.bodiesAt(t));
    }
    std::vector<Ghost> trail(times.size()), keys(times.size());
    for (std::size_t body = 0; body < timeline.tracks().size(); ++body) {
        std::vector<Pose> poses;
        for (const std::vector<Thing>& moment : moments) {
            poses.push_back(moment[body].pose);
        }
        const std::vector<bool> is_key = keyGhosts(*timeline.tracks()[body].shape(), poses, upOf(scene.gravity));
        for (std::size_t i = 0; i < times.size(); ++i) {
            (all_keys || is_key[i] ? keys : trail)[i].things.push_back(moments[i][body]);
        }
    }
    std::vector<Ghost> ghosts;
    for (std::size_t i = 0; i < times.size(); ++i) {
        trail[i].trail = true;
        const float weight = ghostWeight(i, times.size());
        keys[i].weight = all_keys ? 0.5F + 0.5F * weight : weight;
    }
    for (std::vector<Ghost>* group : {&trail, &keys}) {
        std::copy_if(group->begin(), group->end(), std::back_inserter(ghosts),
                     [](const Ghost& ghost) { return !ghost.things.empty(); });
    }
    return ghosts;
}

/// Mean of exact moments over the open shutter, which is centred on the frame's time.
Picture blurredPicture(const Show& show, double time, double shutter_seconds, int samples) {
    constexpr int kMoments = 12;
    Picture sum = makePicture(show.tracer().background().size);
    for (int i = 0; i < kMoments; ++i) {
        const double share = (static_cast<double>(i) + 0.5) / kMoments - 0.5;
        const Picture moment =
            show.tracer().picture(show.bodiesAt(time + share * shutter_seconds),
                                  {.samples = samples, .seed = sampling::hash(static_cast<std::uint32_t>(i))});
        for (std::size_t p = 0; p < sum.pixels.size(); ++p) {
            sum.pixels[p] += moment.pixels[p] * (1.0F / kMoments);
        }
    }
    return sum;
}

Picture framePicture(const Show& show, double time, const VideoOptions& options) {
    if (options.shutter > 0.0) {
        return blurredPicture(show, time, options.shutter / options.fps, std::max(4, options.samples / 4));
    }
    return show.tracer().picture(show.bodiesAt(time));
}

} // namespace

int frameCount(double duration, double fps) {
    return std::max(1, static_cast<int>(std::ceil(duration * fps - 1e-6)));
}

Result<Rendered> renderStrobe(const Scene& scene, const Timeline& timeline, const StrobeOptions& options,
                              const std::string& path) {
    std::vector<double> times = options.times;
    if (times.empty()) {
        times = strobeTimes(scene.strobe, timeline.end());
    }
    if (times.empty()) {
        return Error{"the strobe has no moment: \"from\" lies after \"to\" or after the end", path};
    }
    const ShowSpan span{times.front(), times.back(), scene.strobe.spread};
    auto made = Show::create(scene, timeline, span, options.size, {options.samples, options.threads});
    if (!made) {
        return made.error();
    }
    Show& show = made.value();
    if (options.times.empty()) { // ghosts of bodies that all stand still say nothing new
        while (times.size() > 1 && !show.changes(times[times.size() - 2], times.back())) {
            times.pop_back();
        }
    }
    show.setTime(times.back());
    const std::vector<Ghost> ghosts = ghostsAt(show, scene, timeline, times, !options.times.empty());
    Progress progress("ghosts", static_cast<double>(ghosts.size()));
    const Picture picture = strobePicture(show.tracer(), ghosts, [&](std::size_t index) {
        progress.at(static_cast<double>(index + 1));
        return !interrupted();
    });
    if (interrupted()) {
        return stopped(path);
    }
    const auto written = writePng(path, picture);
    if (!written) {
        return written.error();
    }
    return Rendered{options.size, static_cast<int>(times.size())};
}

Result<Rendered> renderStill(const Scene& scene, const Timeline& timeline, double time, const PictureOptions& options,
                             const std::string& path) {
    // Framed as the video is, so that a still can be compared with its frame.
    const ShowSpan span{timeline.start(), timeline.end(), Vec3(0.0)};
    auto made = Show::create(scene, timeline, span, options.size, {options.samples, options.threads});
    if (!made) {
        return made.error();
    }
    made.value().setTime(time);
    const Picture picture = made.value().tracer().picture(made.value().bodiesAt(time));
    if (interrupted()) {
        return stopped(path);
    }
    const auto written = writePng(path, picture);
    if (!written) {
        return written.error();
    }
    return Rendered{options.size, 1};
}

Result<Rendered> renderVideo(const Scene& scene, const Timeline& timeline, const VideoOptions& options,
                             const std::string& path) {
    const PictureSize size = videoSize(path, options.size);
    const int end = options.end_frame < 0 ? frameCount(timeline.end(), options.fps) : options.end_frame;
    if (options.first_frame < 0 || options.first_frame >= end) {
        return Error{"there is no frame to draw", path};
    }
    auto writer = VideoWriter::create(path, size, options.fps);
    if (!writer) {
        return writer.error();
    }
    const ShowSpan span{timeline.start(), timeline.end(), Vec3(0.0)};
    auto made = Show::create(scene, timeline, span, size, {options.samples, options.threads});
    if (!made) {
        return made.error();
    }
    Show& show = made.value();
    Progress progress("frames", static_cast<double>(end - options.first_frame));
    Picture picture;
    for (int frame = options.first_frame; frame < end; ++frame) {
        const double time = static_cast<double>(frame) / options.fps;
        const double before = static_cast<double>(frame - 1) / options.fps;
        if (frame == options.first_frame || show.changes(before, time)) {
            show.setTime(time);
            picture = framePicture(show, time, options);
        }
        if (interrupted()) {
            return stopped(path);
        }
        const auto written = writer.value().write(picture);
        if (!written) {
            return written.error();
        }
        progress.at(static_cast<double>(frame + 1 - options.first_frame));
    }
    const auto finished = writer.value().finish();
    if (!finished) {
        return finished.error();
    }
    return Rendered{size, end - options.first_frame};
}

} // namespace elastoon
