// elastoon figures: the paper's figures from scenes/figures/, each as a picture and where it is motion as a video.
#include "commands.h"
#include "curve_figure.h"
#include "game_figure.h"
#include "model_plots.h"
#include "render.h"
#include "sheet.h"
#include "strobe.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

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

/// What the picture of a figure shows.
enum class Look : std::uint8_t {
    Strobe,     ///< as the scene's strobe says
    FiveFrames, ///< about the first impact: figures 2 and 3
    Collision,  ///< all of it, the impacts sampled more densely than the flight: figure 5
    Sheet,      ///< nine frames with ghosts, from the first touch: figure 7
};

struct FigureScene {
    int number;
    const char* stem;
    Look look;
};
constexpr FigureScene kFigureScenes[] = {
    {1, "1-bouncing-ball", Look::Strobe},     {2, "2-stiff-cylinder", Look::FiveFrames},
    {3, "3-soft-cylinder", Look::FiveFrames}, {5, "5-angled-cylinder", Look::Collision},
    {6, "6-left-corner", Look::Strobe},       {6, "6-right-corner", Look::Strobe},
    {7, "7-floor-then-wall", Look::Sheet},
};

double endOf(const Event& impact) {
    return impact.time + impact.t_in + impact.t_out;
}

const Event* firstImpact(const Timeline& timeline) {
    const auto& events = timeline.events();
    const auto found =
        std::find_if(events.begin(), events.end(), [](const Event& event) { return event.type == EventType::Impact; });
    return found == events.end() ? nullptr : &*found;
}

/// In the fall, at the touch, at the deepest squash, at take-off, and on the way up, of the first impact.
std::vector<double> fiveFrames(const Timeline& timeline) {
    constexpr double kBeforeAndAfter = 0.3;
    const Event* impact = firstImpact(timeline);
    if (impact == nullptr) {
        return {};
    }
    return {std::max(0.0, impact->time - kBeforeAndAfter), impact->time, impact->time + impact->t_in, endOf(*impact),
            endOf(*impact) + kBeforeAndAfter};
}

/// The strobe's times in flight; in impacts the touch, the release, the deepest squash, and half-way to it and from it.
std::vector<double> collisionTimes(const Scene& scene, const Timeline& timeline) {
    std::vector<double> times = strobeTimes(scene.strobe, timeline.end());
    const double margin = 0.4 * scene.strobe.every; // a ghost of the flight that near would only blot
    for (const Event& event : timeline.events()) {
        if (event.type == EventType::Impact) {
            std::erase_if(times, [&](double t) { return t > event.time - margin && t < endOf(event) + margin; });
            times.insert(times.end(), {event.time, event.time + 0.5 * event.t_in, event.time + event.t_in,
                                       event.time + event.t_in + 0.5 * event.t_out, endOf(event)});
        }
    }
    std::sort(times.begin(), times.end());
    return times;
}

/// The first impact takes the first half of the sheet: it ends in the middle frame, as the paper's caption says.
SheetOptions nineFrames(const Timeline& timeline) {
    constexpr int kMiddle = 4, kFrames = 9;
    SheetOptions options;
    options.columns = options.rows = 3;
    options.ghosts = 3;
    if (const Event* impact = firstImpact(timeline)) {
        const double step = (endOf(*impact) - impact->time) / kMiddle;
        options.ghost_every = step / 2.0;
        for (int i = 0; i < kFrames; ++i) {
            options.times.push_back(std::min(impact->time + i * step, timeline.end()));
        }
    }
    return options;
}

void report(const std::string& path) {
    fmt::print("wrote {}\n", path);
}

void makeSceneFigure(const FiguresOptions& options, const FigureScene& figure) {
    const Scene scene = loadScene(fmt::format("{}/{}.json", options.scenes, figure.stem));
    const Performance performance = perform(scene, scene.duration);
    const std::string stem = fmt::format("{}/figure-{}", options.folder, figure.stem);
    const Timeline& timeline = performance.timeline;
    if (figure.look == Look::Sheet) {
        SheetOptions sheet = nineFrames(timeline);
        sheet.samples = options.samples;
        (void)orFail(renderSheet(scene, timeline, sheet, stem + ".png"));
    } else {
        StrobeOptions strobe;
        strobe.samples = options.samples;
        strobe.times = figure.look == Look::FiveFrames  ? fiveFrames(timeline)
                       : figure.look == Look::Collision ? collisionTimes(scene, timeline)
                                                        : std::vector<double>{};
        (void)orFail(renderStrobe(scene, timeline, strobe, stem + ".png"));
    }
    report(stem + ".png");
    if (!options.no_video) {
        VideoOptions video;
        video.size = {960, 540};
        video.samples = std::max(1, options.samples / 4);
        (void)orFail(renderVideo(scene, timeline, video, stem + ".mp4"));
        report(stem + ".mp4");
    }
}

void makeGameFigure(const FiguresOptions& options) {
    const PlayedSequence played = orFail(playSequence(options.scenes + "/8-squashout"), kExitBadUse);
    const std::string stem = options.folder + "/figure-8-squashout";
    StrobeOptions strobe;
    strobe.size = {720, 1000};
    strobe.samples = options.samples;
    (void)orFail(renderStrobe(played.scene, played.timeline, strobe, stem + ".png"));
    report(stem + ".png");
    if (!options.no_video) {
        VideoOptions video;
        video.size = {540, 750};
        video.samples = std::max(1, options.samples / 4);
        (void)orFail(renderVideo(played.film, played.timeline, video, stem + ".mp4"));
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
    if (wanted(8)) {
        makeGameFigure(options);
    }
    if (options.plots) {
        orFail(writeModelPlots(options.folder));
        report(options.folder + "/model_*.svg");
    }
}

} // namespace

void addFiguresCommand(CLI::App& app) {
    auto options = std::make_shared<FiguresOptions>();
    CLI::App* command = app.add_subcommand("figures", "Make the paper's figures");
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
