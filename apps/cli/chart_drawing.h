// Lays a chart out and draws it with cairo, on whatever surface.
#pragma once

#include "chart.h"

#include <cairo.h>

namespace elastoon {

/// Draws the chart into 0,0 .. width,height of the context.
void drawChart(cairo_t* cairo, const Chart& chart);

} // namespace elastoon
