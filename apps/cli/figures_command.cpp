// elastoon figures: the paper's figures from scenes/figures/, each as a picture and where it is motion as a video.
#include "commands.h"
#include "curve_figure.h"
#include "model_plots.h"
#include "render.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

namespace elastoon {

namespace {

struct FiguresOptions {
    std::string folder;
    std::string scenes = "scenes/figures";
    std::vector<int> only;
    bool plots = false;
    bool no_video = false;
    int samples = 32;
};

struct FigureScene {
    int number;
    const char* stem;
    bool five_frames; ///< as the paper's captions of figures 2 and 3 say; else a strobe
};
constexpr FigureScene kFigureScenes[] = {
    {1, "1-bouncing-ball", false}, {2, "2-stiff-cylinder", true}, {3, "3-soft-cylinder", true}};

/// In the fall, at the touch, at the deepest squash, at take-off, and on the way up, of the first impact.
std::vector<double> fiveFrames(const Timeline& timeline) {
    constexpr double kBeforeAndAfter = 0.3;
    for (const Event& event : timeline.events()) {
        if (event.type == EventType::Impact) {
            const double out = event.time + event.t_in + event.t_out;
            return {std::max(0.0, event.time - kBeforeAndAfter), event.time, event.time + event.t_in, out,
                    out + kBeforeAndAfter};
        }
    }
    return {};
}

void report(const std::string& path) {
    fmt::print("wrote {}\n", path);
}

void makeSceneFigure(const FiguresOptions& options, const FigureScene& figure) {
    const Scene scene = loadScene(fmt::format("{}/{}.json", options.scenes, figure.stem));
    const Performance performance = perform(scene, scene.duration);
    StrobeOptions strobe;
    strobe.samples = options.samples;
    if (figure.five_frames) {
        strobe.times = fiveFrames(performance.timeline);
    }
    const std::string stem = fmt::format("{}/figure-{}", options.folder, figure.stem);
    (void)orFail(renderStrobe(scene, performance.timeline, strobe, stem + ".png"));
    report(stem + ".png");
    if (!options.no_video) {
        VideoOptions video;
        video.size = {960, 540};
        video.samples = std::max(1, options.samples / 4);
        (void)orFail(renderVideo(scene, performance.timeline, video, stem + ".mp4"));
        report(stem + ".mp4");
    }
}

void makeFigures(const FiguresOptions& options) {
    const auto wanted = [&](int number) {
        return options.only.empty() ||
               std::find(options.only.begin(), options.only.end(), number) != options.only.end();
    };
    for (const FigureScene& figure : kFigureScenes) {
        if (wanted(figure.number)) {
            makeSceneFigure(options, figure);
        }
    }
    if (wanted(4)) {
        for (const char* ending : {".svg", ".pdf", ".png"}) {
            const std::string path = options.folder + "/figure-4-interpolation" + ending;
            orFail(writeCurveFigure(path));
            report(path);
        }
    }
    for (int number = 5; number <= 8; ++number) {
        if (wanted(number)) {
            fmt::print("figure {}: not yet\n", number);
        }
    }
    if (options.plots) {
        orFail(writeModelPlots(options.folder));
        report(options.folder + "/model_*.svg");
    }
}

} // namespace

void addFiguresCommand(CLI::App& app) {
    auto options = std::make_shared<FiguresOptions>();
    CLI::App* command = app.add_subcommand("figures", "Make the paper's figures (1 to 4 today)");
    command->add_option("-o,--output", options->folder, "Folder to write to; made where it is missing")->required();
    command->add_option("--scenes", options->scenes, "Folder of the figures' scenes")->capture_default_str();
    command->add_option("--only", options->only, "Only figures of these numbers")->check(between(1, 8));
    command->add_option("--samples", options->samples, "Most rays for a pixel of a picture; a video takes a quarter")
        ->check(between(1, 4096))
        ->capture_default_str();
    command->add_flag("--no-video", options->no_video, "Pictures only");
    command->add_flag("--plots", options->plots, "Also the plots of docs/model.md");
    command->callback([options] { makeFigures(*options); });
}

} // namespace elastoon
