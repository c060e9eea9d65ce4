// Text of charts with a little markup: *italic*, _{subscript}, ^{superscript}. Drawn with cairo.
#pragma once

#include "elastoon/math.h"

#include <cairo.h>

#include <string>
#include <string_view>

namespace elastoon {

struct TextLook {
    double size = 12.0; ///< points
    bool bold = false;
    Vec3 color{0.15}; ///< sRGB 0..1
};

/// Where the text stands about its point: 0 begins there, 0.5 is centred, 1 ends there.
enum class TextAlign : std::uint8_t { Left, Center, Right };

/// Sets the font options that give the same outlines on every surface.
void prepareText(cairo_t* cairo);

/// From now on drawText() on this context adds SVG text elements to `out_svg` and draws nothing: as outlines, the
/// letters would be nine tenths of the file, and could not be searched. `out_svg` must outlive the context.
void writeTextAsSvg(cairo_t* cairo, std::string& out_svg);

/// Width of the marked-up text, points.
[[nodiscard]] double textWidth(cairo_t* cairo, std::string_view markup, const TextLook& look);

/// Draws the text with its baseline at y.
void drawText(cairo_t* cairo, double x, double y, std::string_view markup, const TextLook& look,
              TextAlign align = TextAlign::Left);

} // namespace elastoon
