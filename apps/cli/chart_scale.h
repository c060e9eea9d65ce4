// From a chart's numbers to places on the page: linear and logarithmic scales and their ticks.
#pragma once

#include "chart.h"

namespace elastoon {

/// Maps an axis onto begin..end points of the page.
struct ChartScale {
    double from = 0.0, to = 1.0, begin = 0.0, end = 1.0;
    bool logarithmic = false;

    [[nodiscard]] double at(double value) const;
};

/// The axis's own ticks, or about `wanted` round ones inside it; powers of ten where it is logarithmic.
[[nodiscard]] std::vector<ChartTick> ticksOf(const ChartAxis& axis, int wanted);

/// 2..9 times each power of ten inside a logarithmic axis; nothing on a linear one.
[[nodiscard]] std::vector<double> minorTicksOf(const ChartAxis& axis);

/// The polyline without the points that stray less than `tolerance` from what is left (Douglas and Peucker 1973):
/// a smooth curve needs few points where it is nearly straight, and files stay small.
[[nodiscard]] std::vector<ChartPoint> simplified(const std::vector<ChartPoint>& line, double tolerance);

} // namespace elastoon
