// See chart_drawing.h.
#include "chart_drawing.h"

#include "chart_scale.h"
#include "chart_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace elastoon {

namespace {

constexpr Vec3 kInk{0.13, 0.15, 0.18};
constexpr Vec3 kGrey{0.40, 0.43, 0.47};
constexpr Vec3 kGrid{0.90, 0.91, 0.925};
constexpr Vec3 kAxisLine{0.45, 0.47, 0.50};
constexpr double kEdge = 18.0; // white space at the rim
constexpr double kTickSize = 11.0;
constexpr double kLabelSize = 12.0;
constexpr double kCaptionSize = 11.5;
constexpr double kTitleSize = 15.0;
const TextLook kTickLook{kTickSize, false, kGrey};
const TextLook kLabelLook{kLabelSize, false, kInk};

/// The parts of a chart that everything is drawn from.
struct Layout {
    double left = 0.0, right = 0.0, top = 0.0, bottom = 0.0; // of the plot
    ChartScale x, y;
    double axis_x = 0.0, axis_y = 0.0; // where the y axis and the x axis stand
    std::vector<ChartTick> x_ticks, y_ticks;
};

void setColor(cairo_t* cairo, const Vec3& color, double opacity = 1.0) {
    if (opacity < 1.0) {
        cairo_set_source_rgba(cairo, color.r, color.g, color.b, opacity);
    } else {
        cairo_set_source_rgb(cairo, color.r, color.g, color.b);
    }
}

void setDash(cairo_t* cairo, LineDash dash, double width) {
    const std::array<double, 2> pattern =
        dash == LineDash::Dashed ? std::array{3.2 * width, 2.2 * width} : std::array{0.01, 2.1 * width};
    cairo_set_line_cap(cairo, dash == LineDash::Dashed ? CAIRO_LINE_CAP_BUTT : CAIRO_LINE_CAP_ROUND);
    cairo_set_dash(cairo, pattern.data(), dash == LineDash::Solid ? 0 : 2, 0.0);
}

void strokeLine(cairo_t* cairo, const ChartPoint& from, const ChartPoint& to, const Vec3& color, double width) {
    setColor(cairo, color);
    cairo_set_line_width(cairo, width);
    cairo_move_to(cairo, from.x, from.y);
    cairo_line_to(cairo, to.x, to.y);
    cairo_stroke(cairo);
}

Layout layOut(cairo_t* cairo, const Chart& chart) {
    Layout layout;
    layout.y_ticks = ticksOf(chart.y, std::max(3, static_cast<int>(chart.height / 70.0)));
    layout.x_ticks = ticksOf(chart.x, std::max(4, static_cast<int>(chart.width / 85.0)));
    double widest = 0.0;
    for (const ChartTick& tick : layout.y_ticks) {
        widest = std::max(widest, textWidth(cairo, tick.label, kTickLook));
    }
    const double title = (chart.title.empty() ? 0.0 : 24.0) + (chart.subtitle.empty() ? 0.0 : 18.0);
    const double y_label = chart.y.label.empty() || chart.y.at_zero ? 8.0 : 26.0;
    layout.left = kEdge + widest + 9.0;
    layout.right = chart.width - kEdge - 6.0;
    layout.top = kEdge + title + y_label;
    layout.bottom = chart.height - kEdge - 20.0 - (chart.x.label.empty() || chart.x.at_zero ? 0.0 : 20.0);
    layout.x = {chart.x.from, chart.x.to, layout.left, layout.right, chart.x.logarithmic};
    layout.y = {chart.y.from, chart.y.to, layout.bottom, layout.top, chart.y.logarithmic};
    layout.axis_x = chart.y.at_zero ? layout.x.at(0.0) : layout.left;
    layout.axis_y = chart.x.at_zero ? layout.y.at(0.0) : layout.bottom;
    return layout;
}

void drawTitle(cairo_t* cairo, const Chart& chart) {
    double y = kEdge + 0.8 * kTitleSize;
    if (!chart.title.empty()) {
        drawText(cairo, kEdge, y, chart.title, {kTitleSize, true, kInk});
        y += 19.0;
    }
    drawText(cairo, kEdge, y, chart.subtitle, {kLabelSize, false, kGrey});
}

void drawSpans(cairo_t* cairo, const Chart& chart, const Layout& layout) {
    for (const ChartSpan& span : chart.spans) {
        const double from = layout.x.at(span.from);
        const double to = layout.x.at(span.to);
        const double bottom = std::min(layout.bottom, layout.axis_y);
        setColor(cairo, span.color, 0.09);
        cairo_rectangle(cairo, from, layout.top, to - from, bottom - layout.top);
        cairo_fill(cairo);
        drawText(cairo, 0.5 * (from + to), layout.top + 17.0, span.caption, {kCaptionSize, false, 0.75 * span.color},
                 TextAlign::Center);
    }
}

void drawGrid(cairo_t* cairo, const Chart& chart, const Layout& layout) {
    setDash(cairo, LineDash::Solid, 1.0);
    if (chart.y.grid) {
        for (const ChartTick& tick : layout.y_ticks) {
            const double y = layout.y.at(tick.value);
            strokeLine(cairo, {layout.left, y}, {layout.right, y}, kGrid, 0.8);
        }
    }
    if (chart.x.grid) {
        for (const ChartTick& tick : layout.x_ticks) {
            const double x = layout.x.at(tick.value);
            strokeLine(cairo, {x, layout.top}, {x, layout.bottom}, kGrid, 0.8);
        }
    }
}

/// An axis line; its head is an arrow in a sketch.
void drawAxisLine(cairo_t* cairo, const ChartPoint& from, const ChartPoint& to, bool arrow) {
    strokeLine(cairo, from, to, arrow ? kInk : kAxisLine, arrow ? 1.2 : 1.0);
    if (!arrow) {
        return;
    }
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    const ChartPoint along{(to.x - from.x) / length, (to.y - from.y) / length};
    cairo_move_to(cairo, to.x + 5.0 * along.x, to.y + 5.0 * along.y);
    for (const double side : {3.4, -3.4}) {
        cairo_line_to(cairo, to.x - 4.0 * along.x - side * along.y, to.y - 4.0 * along.y + side * along.x);
    }
    cairo_close_path(cairo);
    cairo_fill(cairo);
}

void drawAxes(cairo_t* cairo, const Chart& chart, const Layout& layout) {
    setDash(cairo, LineDash::Solid, 1.0);
    drawAxisLine(cairo, {layout.left, layout.axis_y}, {layout.right, layout.axis_y}, chart.x.at_zero);
    if (chart.y.at_zero || chart.y.logarithmic || !chart.y.grid) {
        drawAxisLine(cairo, {layout.axis_x, layout.bottom}, {layout.axis_x, layout.top}, chart.y.at_zero);
    }
    for (const ChartTick& tick : layout.x_ticks) {
        const double x = layout.x.at(tick.value);
        strokeLine(cairo, {x, layout.axis_y}, {x, layout.axis_y + 4.5}, kAxisLine, 1.0);
        drawText(cairo, x, layout.axis_y + 9.0 + 0.75 * kTickSize, tick.label, kTickLook, TextAlign::Center);
    }
    for (const ChartTick& tick : layout.y_ticks) {
        const double y = layout.y.at(tick.value);
        drawText(cairo, layout.axis_x - 8.0, y + 0.36 * kTickSize, tick.label, kTickLook, TextAlign::Right);
    }
    for (const double value : minorTicksOf(chart.x)) {
        const double x = layout.x.at(value);
        strokeLine(cairo, {x, layout.axis_y}, {x, layout.axis_y + 2.5}, kAxisLine, 0.7);
    }
    for (const double value : minorTicksOf(chart.y)) {
        const double y = layout.y.at(value);
        strokeLine(cairo, {layout.axis_x - 2.5, y}, {layout.axis_x, y}, kAxisLine, 0.7);
    }
}

void drawAxisLabels(cairo_t* cairo, const Chart& chart, const Layout& layout) {
    if (chart.x.at_zero) {
        drawText(cairo, layout.right + 2.0, layout.axis_y - 10.0, chart.x.label, kLabelLook, TextAlign::Right);
    } else {
        drawText(cairo, layout.right, chart.height - kEdge, chart.x.label, kLabelLook, TextAlign::Right);
    }
    if (chart.y.at_zero) {
        drawText(cairo, layout.axis_x + 10.0, layout.top + 2.0, chart.y.label, kLabelLook);
    } else {
        drawText(cairo, kEdge, layout.top - 12.0, chart.y.label, kLabelLook);
    }
}

void drawCurve(cairo_t* cairo, const ChartCurve& curve, const Layout& layout) {
    std::vector<ChartPoint> line;
    for (const ChartPoint& point : curve.points) {
        line.push_back({layout.x.at(point.x), layout.y.at(point.y)});
    }
    setColor(cairo, curve.color);
    cairo_set_line_width(cairo, curve.width);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    setDash(cairo, curve.dash, curve.width);
    for (const ChartPoint& point : simplified(line, 0.04)) {
        cairo_line_to(cairo, point.x, point.y);
    }
    cairo_stroke(cairo);
}

void drawCurves(cairo_t* cairo, const Chart& chart, const Layout& layout) {
    cairo_save(cairo);
    cairo_rectangle(cairo, layout.left, layout.top - 2.0, layout.right - layout.left, layout.bottom - layout.top + 4.0);
    cairo_clip(cairo);
    for (const ChartCurve& curve : chart.curves) {
        drawCurve(cairo, curve, layout);
    }
    cairo_restore(cairo);
    setDash(cairo, LineDash::Solid, 1.0);
}

void drawGuides(cairo_t* cairo, const ChartPoint& at, const Layout& layout) {
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_BUTT);
    const std::array<double, 2> pattern{4.0, 3.0};
    cairo_set_dash(cairo, pattern.data(), 2, 0.0);
    strokeLine(cairo, at, {at.x, layout.axis_y}, kGrey, 0.9);
    strokeLine(cairo, at, {layout.axis_x, at.y}, kGrey, 0.9);
    setDash(cairo, LineDash::Solid, 1.0);
}

void drawCaption(cairo_t* cairo, const ChartMark& mark, const ChartPoint& at, bool veiled) {
    using enum CaptionSide;
    const CaptionSide side = mark.side;
    const bool left = side == Left || side == AboveLeft || side == BelowLeft;
    const bool right = side == Right || side == AboveRight || side == BelowRight;
    const bool above = side == Above || side == AboveLeft || side == AboveRight;
    const bool below = side == Below || side == BelowLeft || side == BelowRight;
    const double aside = above || below ? 7.0 : 10.0;
    const double x = at.x + (left ? -aside : right ? aside : 0.0);
    const double y = at.y + (above ? -9.0 : below ? 9.0 + 0.75 * kCaptionSize : 0.36 * kCaptionSize);
    const TextLook look{kCaptionSize, false, mark.color};
    if (veiled) {
        const double width = textWidth(cairo, mark.caption, look);
        setColor(cairo, Vec3(1.0), 0.8);
        cairo_rectangle(cairo,
                        x -
                            (left    ? width
                             : right ? 0.0
                                     : 0.5 * width) -
                            2.0,
                        y - 0.85 * kCaptionSize, width + 4.0, 1.12 * kCaptionSize);
        cairo_fill(cairo);
    }
    drawText(cairo, x, y, mark.caption, look, left ? TextAlign::Right : right ? TextAlign::Left : TextAlign::Center);
}

void drawMarks(cairo_t* cairo, const Chart& chart, const Layout& layout) {
    for (const ChartMark& mark : chart.marks) {
        const ChartPoint at{layout.x.at(mark.at.x), layout.y.at(mark.at.y)};
        if (!mark.caption.empty()) {
            // A veil of white keeps the words readable on grid lines; on a shaded span it would show.
            drawCaption(cairo, mark, at, chart.spans.empty());
        }
        if (mark.dot) {
            setColor(cairo, Vec3(1.0));
            cairo_arc(cairo, at.x, at.y, 5.2, 0.0, 2.0 * std::numbers::pi);
            cairo_fill(cairo);
            setColor(cairo, mark.color);
            cairo_arc(cairo, at.x, at.y, 3.7, 0.0, 2.0 * std::numbers::pi);
            cairo_fill(cairo);
        }
    }
}

void drawLegend(cairo_t* cairo, const Chart& chart, const Layout& layout) {
    constexpr double kRow = 18.0;
    constexpr double kSample = 26.0;
    double width = 0.0;
    double rows = 0.0;
    for (const ChartCurve& curve : chart.curves) {
        width = std::max(width, textWidth(cairo, curve.label, {kCaptionSize, false, kInk}));
        rows += curve.label.empty() ? 0.0 : 1.0;
    }
    if (rows == 0.0 || chart.legend == LegendPlace::None) {
        return;
    }
    width += kSample + 8.0;
    const bool left = chart.legend == LegendPlace::TopLeft || chart.legend == LegendPlace::BottomLeft;
    const bool top = chart.legend == LegendPlace::TopLeft || chart.legend == LegendPlace::TopRight;
    const double x = left ? layout.left + 14.0 : layout.right - width - 8.0;
    const double height = rows * kRow;
    double y = top                                  ? layout.top + 8.0
               : chart.legend == LegendPlace::Right ? 0.5 * (layout.top + layout.bottom - height)
                                                    : layout.bottom - height - 10.0;
    setColor(cairo, Vec3(1.0), 0.88);
    cairo_rectangle(cairo, x - 6.0, y - 4.0, width + 12.0, height + 8.0);
    cairo_fill(cairo);
    for (const ChartCurve& curve : chart.curves) {
        if (curve.label.empty()) {
            continue;
        }
        setDash(cairo, curve.dash, curve.width);
        strokeLine(cairo, {x, y + 0.5 * kRow}, {x + kSample, y + 0.5 * kRow}, curve.color, curve.width);
        drawText(cairo, x + kSample + 8.0, y + 0.5 * kRow + 0.36 * kCaptionSize, curve.label,
                 {kCaptionSize, false, kInk});
        y += kRow;
    }
    setDash(cairo, LineDash::Solid, 1.0);
}

} // namespace

void drawChart(cairo_t* cairo, const Chart& chart) {
    prepareText(cairo);
    setColor(cairo, Vec3(1.0));
    cairo_paint(cairo);
    const Layout layout = layOut(cairo, chart);
    drawTitle(cairo, chart);
    drawGrid(cairo, chart, layout);
    drawSpans(cairo, chart, layout);
    for (const ChartMark& mark : chart.marks) {
        if (mark.guides) {
            drawGuides(cairo, {layout.x.at(mark.at.x), layout.y.at(mark.at.y)}, layout);
        }
    }
    drawAxes(cairo, chart, layout);
    drawAxisLabels(cairo, chart, layout);
    drawCurves(cairo, chart, layout);
    drawLegend(cairo, chart, layout);
    drawMarks(cairo, chart, layout);
}

} // namespace elastoon
