// See curve_figure.h.
#include "curve_figure.h"

#include "chart.h"

#include <fmt/format.h>

#include <cmath>

namespace elastoon {

namespace {

constexpr int kSamples = 400;
constexpr double kFallHeight = 10.0; // m
constexpr double kGravity = 9.81;    // m/s^2

ChartCurve piece(const ImpactCurve& curve, double from, double to, const Vec3& color) {
    ChartCurve line;
    line.color = color;
    line.width = 2.8;
    for (int i = 0; i <= kSamples; ++i) {
        const double t = from + (to - from) * i / kSamples;
        line.points.push_back({t, curve.at(t)});
    }
    return line;
}

ChartMark key(double t, double s, const char* caption, CaptionSide side, const Vec3& color) {
    ChartMark mark;
    mark.at = {t, s};
    mark.caption = caption;
    mark.side = side;
    mark.color = color;
    mark.guides = true;
    return mark;
}

} // namespace

CurveExample curveExample() {
    CurveExample example;
    Style& style = example.style;
    style.squash_law = SquashLaw::Paper;
    const double speed = std::sqrt(2.0 * kGravity * kFallHeight);
    ImpactInput& input = example.input;
    input.length = 1.0;
    input.speed_in = speed;
    input.s_in = stretchAtSpeed(style, speed);
    input.speed_out = style.restitution * speed;
    input.s_out = stretchAtSpeed(style, input.speed_out);
    input.rest_speed = restSpeed(style, input.length, kGravity);
    input.turns = true;
    example.curve = impactCurve(style, input);
    return example;
}

Status writeCurveFigure(const std::string& path) {
    const ImpactCurve curve = curveExample().curve;
    const double end = curve.duration();
    const Vec3 squash = chartColor(0);
    const Vec3 stretch = chartColor(1);

    Chart chart;
    chart.width = 640.0;
    chart.height = 400.0;
    chart.x = {"time *t*", -0.005, 1.12 * end, false, {}, false, true};
    chart.y = {"stretch *s*", 0.0, 1.9, false, {}, false, true};
    chart.x.ticks = {{0.0, "0"}, {curve.t_in, "*t*_{mid}"}, {end, "*t*_{out}"}};
    chart.y.ticks = {{curve.s_in, "*s*_{in}"}, {curve.s_mid, "*s*_{mid}"}, {1.0, "1"}, {curve.s_out, "*s*_{out}"}};
    chart.legend = LegendPlace::None;
    chart.spans = {{0.0, curve.t_in, "squash", squash}, {curve.t_in, end, "stretch", stretch}};

    ChartCurve unstretched;
    unstretched.points = {{0.0, 1.0}, {chart.x.to, 1.0}};
    unstretched.color = Vec3(0.72);
    unstretched.dash = LineDash::Dotted;
    unstretched.width = 1.2;
    chart.curves = {unstretched, piece(curve, 0.0, curve.t_in, squash), piece(curve, curve.t_in, end, stretch)};
    chart.marks = {key(0.0, curve.s_in, "touch", CaptionSide::AboveRight, squash),
                   key(curve.t_in, curve.s_mid, "deepest squash", CaptionSide::BelowRight, Vec3(0.2)),
                   key(end, curve.s_out, "release", CaptionSide::AboveLeft, stretch)};
    return writeChart(chart, path);
}

} // namespace elastoon
