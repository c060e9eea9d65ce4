// elastoon render: a scene as a picture or as a video.
#include "commands.h"
#include "render.h"
#include "sheet.h"
#include "video.h"

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

namespace elastoon {

namespace {

constexpr int kLeastSide = 16, kMostSide = 8192;
constexpr double kMostFrames = 1e6;

struct RenderCommand {
    std::string scene, output, style;
    bool strobe = false;
    std::optional<double> time, fps, duration;
    std::optional<std::string> size, frames, sheet;
    std::optional<int> samples, ghosts;
    double shutter = 0.0;
};

/// Two whole numbers with `sign` between them, and nothing else.
bool readPair(const std::string& text, char sign, int& first, int& second) {
    const char* const end = text.data() + text.size();
    const auto one = std::from_chars(text.data(), end, first);
    if (one.ec != std::errc() || one.ptr == end || *one.ptr != sign) {
        return false;
    }
    const auto two = std::from_chars(one.ptr + 1, end, second);
    return two.ec == std::errc() && two.ptr == end;
}

PictureSize readSize(const RenderCommand& command, PictureSize standard) {
    PictureSize size = standard;
    if (command.size &&
        (!readPair(*command.size, 'x', size.width, size.height) || std::min(size.width, size.height) < kLeastSide ||
         std::max(size.width, size.height) > kMostSide)) {
        fail({fmt::format("\"{}\" is no size; give WIDTHxHEIGHT, each {} to {}, as in 1280x720", *command.size,
                          kLeastSide, kMostSide),
              "--size"},
             kExitBadUse);
    }
    return size;
}

double readDuration(const RenderCommand& command, const Scene& scene) {
    if (command.duration && !(*command.duration > 0.0 && *command.duration <= 3600.0)) {
        fail({"must be above 0 and at most 3600 s", "--duration"}, kExitBadUse);
    }
    return command.duration.value_or(scene.duration);
}

void readFrames(const RenderCommand& command, double duration, VideoOptions& options) {
    if (command.fps && !(*command.fps >= 1.0 && *command.fps <= 240.0)) {
        fail({"must be 1 to 240", "--fps"}, kExitBadUse);
    }
    options.fps = command.fps.value_or(options.fps);
    if (duration * options.fps > kMostFrames) {
        fail({"would be more than a million frames", "--duration"}, kExitBadUse);
    }
    const int count = frameCount(duration, options.fps);
    options.end_frame = count;
    if (command.frames &&
        (!readPair(*command.frames, ':', options.first_frame, options.end_frame) || options.first_frame < 0 ||
         options.end_frame <= options.first_frame || options.end_frame > count)) {
        fail({fmt::format("\"{}\" is no range of frames; give A:B with 0 <= A < B <= {}; B itself is not drawn",
                          *command.frames, count),
              "--frames"},
             kExitBadUse);
    }
}

/// What holds for every kind of file, and which options this kind does not take.
void checkOptions(const RenderCommand& command, bool video) {
    if (command.samples && (*command.samples < 1 || *command.samples > 4096)) {
        fail({"must be 1 to 4096", "--samples"}, kExitBadUse);
    }
    if (!(command.shutter >= 0.0 && command.shutter <= 1.0)) {
        fail({"must be 0 to 1: a share of the frame's time", "--motion-blur"}, kExitBadUse);
    }
    if (video && (command.strobe || command.time || command.sheet)) {
        fail({"--strobe, --sheet and --time are for .png files", command.output}, kExitBadUse);
    }
    if (!video && command.shutter > 0.0) {
        fail({"--motion-blur is for videos", command.output}, kExitBadUse);
    }
    if (!video && !command.sheet && (command.fps || command.frames)) {
        fail({"--fps and --frames are for videos and for --sheet", command.output}, kExitBadUse);
    }
    if (command.ghosts && !(command.sheet && *command.ghosts >= 0 && *command.ghosts <= 100)) {
        fail({"goes with --sheet, and must be 0 to 100", "--ghosts"}, kExitBadUse);
    }
    if (!video && (command.strobe ? 1 : 0) + (command.time ? 1 : 0) + (command.sheet ? 1 : 0) != 1) {
        fail({"a .png needs one of --strobe (many moments over each other), --sheet COLSxROWS (side by side) and "
              "--time T (one moment)",
              command.output},
             kExitBadUse);
    }
}

/// Frames A to B - 1, evenly spaced where there are more of them than cells.
void chooseFrames(const VideoOptions& frames, SheetOptions& sheet) {
    const int cells = sheet.columns * sheet.rows;
    const int stride = (frames.end_frame - frames.first_frame + cells - 1) / cells;
    for (int frame = frames.first_frame; frame < frames.end_frame; frame += stride) {
        sheet.times.push_back(static_cast<double>(frame) / frames.fps);
        sheet.labels.push_back(std::to_string(frame));
    }
    sheet.ghost_every = 1.0 / frames.fps;
}

Rendered renderCells(const RenderCommand& command, const Scene& scene) {
    const double duration = readDuration(command, scene);
    SheetOptions options;
    options.size = readSize(command, options.size);
    options.samples = command.samples.value_or(options.samples);
    options.ghosts = command.ghosts.value_or(0);
    const bool pair = readPair(*command.sheet, 'x', options.columns, options.rows);
    const int most = std::max(options.size.width, options.size.height) / kLeastCell;
    if (!pair || std::min(options.columns, options.rows) < 1 || std::max(options.columns, options.rows) > most ||
        std::min(cellSize(options).width, cellSize(options).height) < kLeastCell) {
        fail({fmt::format("\"{}\" is no sheet; give COLSxROWS, as in 6x4, with cells of at least {} pixels",
                          *command.sheet, kLeastCell),
              "--sheet"},
             kExitBadUse);
    }
    VideoOptions frames;
    readFrames(command, duration, frames);
    chooseFrames(frames, options);
    const Performance performance = perform(scene, duration);
    return orFail(renderSheet(scene, performance.timeline, options, command.output));
}

Rendered renderPng(const RenderCommand& command, const Scene& scene) {
    const double duration = readDuration(command, scene);
    StrobeOptions options;
    options.size = readSize(command, options.size);
    options.samples = command.samples.value_or(options.samples);
    if (command.time && !(*command.time >= 0.0 && *command.time <= duration)) {
        fail({fmt::format("must be within 0 and the duration, {} s", duration), "--time"}, kExitBadUse);
    }
    const Performance performance = perform(scene, duration);
    return orFail(command.strobe ? renderStrobe(scene, performance.timeline, options, command.output)
                                 : renderStill(scene, performance.timeline, *command.time, options, command.output));
}

Rendered renderFrames(const RenderCommand& command, const Scene& scene, bool gif) {
    const double duration = readDuration(command, scene);
    VideoOptions options;
    options.samples = command.samples.value_or(16);
    options.size = readSize(command, gif ? PictureSize{640, 360} : PictureSize{960, 540});
    options.fps = gif ? 25.0 : 30.0;
    options.shutter = command.shutter;
    readFrames(command, duration, options);
    const Performance performance = perform(scene, duration);
    return orFail(renderVideo(scene, performance.timeline, options, command.output));
}

void run(const RenderCommand& command) {
    const auto begun = std::chrono::steady_clock::now();
    const bool video = isVideoPath(command.output);
    const std::string ending = endingOf(command.output);
    if (!video && ending != ".png") {
        fail({"the ending must be .png, .mp4, .webm or .gif", command.output}, kExitBadUse);
    }
    checkOptions(command, video);
    const Scene scene = loadScene(command.scene, command.style);
    const Rendered done = video           ? renderFrames(command, scene, ending == ".gif")
                          : command.sheet ? renderCells(command, scene)
                                          : renderPng(command, scene);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begun;
    const char* unit = video || command.sheet ? "frames" : command.strobe ? "ghosts" : "moment";
    fmt::print("wrote {}: {}x{}, {} {}, {:.1f} s\n", command.output, done.size.width, done.size.height, done.moments,
               unit, taken.count());
}

} // namespace

void addRenderCommand(CLI::App& app) {
    auto command = std::make_shared<RenderCommand>();
    CLI::App* sub = app.add_subcommand("render", "Draw a scene: a picture (.png) or a video (.mp4, .webm, .gif)");
    sub->add_option("scene", command->scene, "Scene file (.json)")->required();
    sub->add_option("-o,--output", command->output, "File to write; its ending tells the kind")->required();
    sub->add_flag("--strobe", command->strobe, ".png: many moments in one picture, as the scene's \"strobe\" says");
    sub->add_option("--sheet", command->sheet,
                    ".png: COLSxROWS frames side by side; of more frames than that, every second, third, ...");
    sub->add_option("--ghosts", command->ghosts, "--sheet: so many frames before each show as well, pale");
    sub->add_option("--time", command->time, ".png: the moment to draw, s");
    sub->add_option("--size", command->size,
                    "WIDTHxHEIGHT (default: .png 1280x720, video 960x540, .gif 640x360); .mp4 and .webm lose the last "
                    "row or column of an odd size");
    sub->add_option("--fps", command->fps, "Video and sheet: frames per second (default 30; .gif 25)");
    sub->add_option("--frames", command->frames,
                    "Video and sheet: A:B draws frames A to B - 1; frame k shows time k / fps");
    sub->add_option("--duration", command->duration, "Seconds to play (default: the scene's)");
    sub->add_option("--samples", command->samples,
                    "Most rays for a pixel: trades noise for time (default: .png 32, video 16)");
    sub->add_option("--motion-blur", command->shutter,
                    "Video: share of the frame's time that the shutter is open, 0 to 1 (default 0: sharp)");
    addStyleOption(*sub, command->style);
    sub->callback([command] { run(*command); });
}

} // namespace elastoon
