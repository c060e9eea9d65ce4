// Line charts for figures and documents, drawn with cairo. The same chart gives the same bytes.
#pragma once

#include "elastoon/math.h"
#include "elastoon/result.h"

#include <cstdint>
#include <string>
#include <vector>

namespace elastoon {

// Every text may hold the markup of chart_text.h.

struct ChartPoint {
    double x = 0.0, y = 0.0;
};

struct ChartTick {
    double value = 0.0;
    std::string label;
};

struct ChartAxis {
    std::string label;
    double from = 0.0, to = 1.0; ///< from < to; both > 0 where logarithmic
    bool logarithmic = false;
    std::vector<ChartTick> ticks; ///< empty: chosen by themselves
    bool grid = true;             ///< a faint line at each tick
    bool at_zero = false;         ///< its line crosses the other axis at 0 and has an arrowhead, as in a sketch
};

enum class LineDash : std::uint8_t { Solid, Dashed, Dotted };

struct ChartCurve {
    std::string label; ///< in the legend; empty: not there
    std::vector<ChartPoint> points;
    Vec3 color{0.0}; ///< sRGB 0..1
    LineDash dash = LineDash::Solid;
    double width = 2.2; ///< points
};

/// On which side of its point a caption stands.
enum class CaptionSide : std::uint8_t { Above, Below, Left, Right, AboveLeft, AboveRight, BelowLeft, BelowRight };

struct ChartMark {
    ChartPoint at;
    std::string caption;
    CaptionSide side = CaptionSide::AboveRight;
    Vec3 color{0.0};
    bool dot = true;
    bool guides = false; ///< dashed lines to both axes
};

/// A shaded range of x, with a caption at its top.
struct ChartSpan {
    double from = 0.0, to = 0.0;
    std::string caption;
    Vec3 color{0.0}; ///< drawn faintly
};

enum class LegendPlace : std::uint8_t { TopLeft, TopRight, Right, BottomLeft, BottomRight, None };

struct Chart {
    std::string title;    ///< one line; may be empty
    std::string subtitle; ///< one line in grey; may be empty
    double width = 640.0, height = 400.0; ///< points; a PNG has twice as many pixels
    ChartAxis x, y;
    std::vector<ChartCurve> curves;
    std::vector<ChartMark> marks;
    std::vector<ChartSpan> spans;
    LegendPlace legend = LegendPlace::TopRight;
};

/// Colours that tell curves apart, on screen, in print and for colour-blind readers; starts again after six.
[[nodiscard]] Vec3 chartColor(std::size_t index);

/// Draws the chart. The file's ending says the kind: .png, .svg or .pdf.
Status writeChart(const Chart& chart, const std::string& path);

} // namespace elastoon
