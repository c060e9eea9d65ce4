// See model_plots.h.
#include "model_plots.h"

#include "chart.h"
#include "curve_figure.h"
#include "elastoon/world.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>

namespace elastoon {

namespace {

constexpr int kSamples = 600;
constexpr double kGravity = 9.81; // m/s^2
constexpr Vec3 kReference{0.55, 0.57, 0.60};

using Function = std::function<double(double)>;

/// A curve of y(x), sampled evenly in x, or in log x where the axis is logarithmic.
ChartCurve curveOf(const ChartAxis& axis, std::string label, const Vec3& color, const Function& y) {
    ChartCurve curve;
    curve.label = std::move(label);
    curve.color = color;
    for (int i = 0; i <= kSamples; ++i) {
        const double share = static_cast<double>(i) / kSamples;
        const double x = axis.logarithmic ? axis.from * std::pow(axis.to / axis.from, share)
                                          : axis.from + share * (axis.to - axis.from);
        curve.points.push_back({x, y(x)});
    }
    return curve;
}

ChartCurve levelAt(const ChartAxis& axis, double y, std::string label, LineDash dash = LineDash::Dashed) {
    ChartCurve curve;
    curve.label = std::move(label);
    curve.points = {{axis.from, y}, {axis.to, y}};
    curve.color = kReference;
    curve.dash = dash;
    curve.width = 1.3;
    return curve;
}

ChartMark markAt(double x, double y, std::string caption, CaptionSide side, const Vec3& color) {
    ChartMark mark;
    mark.at = {x, y};
    mark.caption = std::move(caption);
    mark.side = side;
    mark.color = color;
    return mark;
}

Chart stretchChart() {
    Chart chart;
    chart.title = "Stretch in flight";
    chart.subtitle =
        "*s* = (*k*_{str} *v* *s*_{max} + 1) / (*k*_{str} *v* + 1); dots: half of the extra stretch, at 1/*k*_{str}";
    chart.x = {"speed *v*, m/s", 0.0, 40.0, false, {}};
    chart.y = {"stretch *s*", 1.0, 3.0, false, {}};
    chart.legend = LegendPlace::TopLeft;
    struct Case {
        double max_stretch, stretch_rate;
    };
    constexpr std::array<Case, 5> kCases{{{3.0, 0.1}, {2.0, 0.5}, {2.0, 0.1}, {2.0, 0.03}, {1.5, 0.1}}};
    for (std::size_t i = 0; i < kCases.size(); ++i) {
        Style style;
        style.max_stretch = kCases[i].max_stretch;
        style.stretch_rate = kCases[i].stretch_rate;
        const std::string label =
            fmt::format("*s*_{{max}} = {}, *k*_{{str}} = {} s/m", style.max_stretch, style.stretch_rate);
        chart.curves.push_back(
            curveOf(chart.x, label, chartColor(i), [&](double v) { return stretchAtSpeed(style, v); }));
        const double half = 1.0 / style.stretch_rate;
        chart.marks.push_back(markAt(half, stretchAtSpeed(style, half), "", CaptionSide::Above, chartColor(i)));
    }
    return chart;
}

Chart squashChart() {
    Chart chart;
    chart.title = "Deepest squash of an impact";
    chart.subtitle = "*s*_{max} = 2, *s*_{min} = 0.5, *k*_{str} = 0.1 s/m";
    chart.x = {"speed relative to the surface, m/s", 0.0, 60.0, false, {}};
    chart.y = {"deepest squash *s*_{mid}", 0.3, 2.2, false, {}};
    chart.legend = LegendPlace::Right;
    Style style;
    const auto law = [&](SquashLaw which) {
        style.squash_law = which;
        return [style](double v) { return deepestSquash(style, v); };
    };
    chart.curves = {curveOf(chart.x, "bounded (default)", chartColor(0), law(SquashLaw::Bounded)),
                    curveOf(chart.x, "paper, misprint mended (0.75 at no speed)", chartColor(1), law(SquashLaw::Paper)),
                    curveOf(chart.x, "paper, as printed: 1 \u2212 (1 \u2212 *s*_{in}) *s*_{in}/*s*_{max}",
                            chartColor(3),
                            [&](double v) {
                                const double s_in = stretchAtSpeed(style, v);
                                return 1.0 - (1.0 - s_in) * s_in / style.max_stretch;
                            }),
                    levelAt(chart.x, 1.0, ""), levelAt(chart.x, style.min_squash, "", LineDash::Dotted)};
    chart.curves[2].dash = LineDash::Dashed;
    const double at_rest = 1.0 - (1.0 - style.min_squash) / style.max_stretch;
    chart.marks = {markAt(0.0, at_rest, "", CaptionSide::Right, chartColor(1)),
                   markAt(chart.x.to, 1.0, "neither squashed nor stretched", CaptionSide::BelowLeft, kReference),
                   markAt(chart.x.to, style.min_squash, "*s*_{min}", CaptionSide::BelowLeft, kReference)};
    chart.marks[1].dot = chart.marks[2].dot = false;
    return chart;
}

/// Duration of the squash half. No rest speed: nothing catches a slow body, the law shows bare.
double contactTime(SquashLaw law, double speed) {
    Style style;
    style.squash_law = law;
    ImpactInput input;
    input.speed_in = speed;
    input.s_in = stretchAtSpeed(style, speed);
    input.speed_out = style.restitution * speed;
    input.s_out = stretchAtSpeed(style, input.speed_out);
    return impactCurve(style, input).t_in;
}

Chart contactTimeChart() {
    Chart chart;
    chart.title = "Duration of the squash";
    chart.subtitle = "*L* = 1 m, *s*_{max} = 2, *s*_{min} = 0.5, *k*_{str} = 0.1 s/m, *k*_{sq} = 1";
    chart.x = {"speed relative to the surface, m/s", 0.01, 100.0, true, {}};
    chart.y = {"duration *t*_{in}, s", 0.01, 100.0, true, {}};
    const Style style;
    const double limit =
        0.5 * std::numbers::pi * style.stretch_rate * (style.max_stretch - style.min_squash) / style.squash_rate;
    chart.curves = {levelAt(chart.x, limit, "limit (\u03c0/2) *L* *k*_{str} (*s*_{max} \u2212 *s*_{min}) / *k*_{sq}"),
                    curveOf(chart.x, "paper", chartColor(1), [](double v) { return contactTime(SquashLaw::Paper, v); }),
                    curveOf(chart.x, "bounded (default)", chartColor(0),
                            [](double v) { return contactTime(SquashLaw::Bounded, v); })};
    const auto mark = [](SquashLaw law, double v, CaptionSide side, const Vec3& color) {
        const double t = contactTime(law, v);
        return markAt(v, t, fmt::format("{:.2g} s at {} m/s", t, v), side, color);
    };
    chart.marks = {mark(SquashLaw::Paper, 0.1, CaptionSide::AboveRight, chartColor(1)),
                   mark(SquashLaw::Bounded, 0.1, CaptionSide::Below, chartColor(0))};
    return chart;
}

/// Angle of the body's axis from the vertical about the apex of a steep throw, degrees over seconds.
Result<ChartCurve> apexCurve(double speed_across, double reversal_rate, double before, double after) {
    auto world = World::create({});
    auto ball = Shape::sphere(0.5);
    if (!world || !ball) {
        return world ? ball.error() : world.error();
    }
    BodyDef def;
    def.shape = ball.value();
    def.style.reversal_rate = reversal_rate;
    def.velocity = {speed_across, kGravity * before, 0.0};
    auto body = world.value().addBody(def);
    if (!body) {
        return body.error();
    }
    const Phase& flight = world.value().phase(body.value());
    ChartCurve curve;
    for (int i = 0; i <= kSamples; ++i) {
        const double t = (before + after) * i / kSamples;
        const Vec3 axis = poseAt(flight, *def.shape, t).orientation * Vec3(1.0, 0.0, 0.0);
        curve.points.push_back({t - before, std::atan2(axis.x, axis.y) * 180.0 / std::numbers::pi});
    }
    return curve;
}

Result<Chart> apexChart() {
    constexpr double kWindow = 0.3; // s on either side of the apex
    constexpr double kNeverReversal = 1e4; // rad/s
    Chart chart;
    chart.title = "The top of a steep throw";
    chart.subtitle = "angle of the axis from the vertical, for three speeds across; reversal rate 4\u03c0 rad/s";
    chart.x = {"time from the apex, s", -kWindow, kWindow, false, {}};
    chart.y = {"angle, degrees", -30.0, 180.0, false, {}};
    chart.y.ticks = {{0.0, "0"}, {45.0, "45"}, {90.0, "90"}, {135.0, "135"}, {180.0, "180"}};
    chart.legend = LegendPlace::TopLeft;
    constexpr std::array<double, 3> kSpeeds{0.01, 0.1, 0.5};
    for (const bool reversal : {false, true}) {
        for (std::size_t i = 0; i < kSpeeds.size(); ++i) {
            const double rate = reversal ? Style{}.reversal_rate : kNeverReversal;
            Result<ChartCurve> curve = apexCurve(kSpeeds[i], rate, kWindow, kWindow);
            if (!curve) {
                return curve.error();
            }
            curve.value().color = chartColor(i);
            curve.value().dash = reversal ? LineDash::Solid : LineDash::Dashed;
            curve.value().width = reversal ? 2.4 : 1.6;
            curve.value().label =
                fmt::format("{}, {} m/s across", reversal ? "ends swapped" : "along the velocity", kSpeeds[i]);
            chart.curves.push_back(curve.value());
        }
    }
    return chart;
}

Chart turnChart() {
    Chart chart;
    const ImpactCurve curve = curveExample().curve;
    chart.title = "Turn about the contact";
    chart.subtitle = "the impact of the paper's figure 4: *t*_{in} = 0.110 s, *t*_{out} = 0.181 s";
    chart.x = {"time from the touch, s", 0.0, curve.duration(), false, {}};
    chart.y = {"share of the turn", 0.0, 1.0, false, {}};
    chart.legend = LegendPlace::TopLeft;
    const auto share = [&](ImpactEasing easing) {
        return [&curve, easing](double t) { return turnShare(curve, easing, t); };
    };
    chart.curves = {curveOf(chart.x, "linear, the paper's", chartColor(1), share(ImpactEasing::Linear)),
                    curveOf(chart.x, "smooth (default)", chartColor(0), share(ImpactEasing::Smooth))};
    chart.curves[0].dash = LineDash::Dashed;
    ChartMark half = markAt(curve.t_in, 0.5, "deepest squash: half of the turn", CaptionSide::BelowRight, Vec3(0.2));
    half.guides = true;
    chart.marks = {half};
    return chart;
}

} // namespace

Status writeModelPlots(const std::string& folder) {
    const auto place = [&](const char* name) { return (std::filesystem::path(folder) / name).string(); };
    const Result<Chart> apex = apexChart();
    if (!apex) {
        return apex.error();
    }
    const std::array<std::pair<Chart, const char*>, 5> plots{{{stretchChart(), "model_stretch.svg"},
                                                              {squashChart(), "model_squash.svg"},
                                                              {contactTimeChart(), "model_contact_time.svg"},
                                                              {apex.value(), "model_apex.svg"},
                                                              {turnChart(), "model_turn.svg"}}};
    for (const auto& [chart, name] : plots) {
        Status written = writeChart(chart, place(name));
        if (!written) {
            return written;
        }
    }
    return success();
}

} // namespace elastoon
