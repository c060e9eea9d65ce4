// See chart_text.h.
#include "chart_text.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace elastoon {

namespace {

constexpr const char* kTextFont = "DejaVu Sans";
constexpr const char* kSymbolFont = "DejaVu Serif";
constexpr double kScriptSize = 0.72;

struct Run {
    std::string text;
    bool italic = false;
    int script = 0; // -1 below, 1 above the line
};

std::vector<Run> parseRuns(std::string_view markup) {
    std::vector<Run> runs{{}};
    const auto begin = [&](bool italic, int script) { runs.push_back({{}, italic, script}); };
    for (std::size_t i = 0; i < markup.size(); ++i) {
        const char c = markup[i];
        const bool opens = (c == '_' || c == '^') && i + 1 < markup.size() && markup[i + 1] == '{';
        if (c == '*') {
            begin(!runs.back().italic, runs.back().script);
        } else if (opens) {
            begin(false, c == '_' ? -1 : 1);
            ++i;
        } else if (c == '}' && runs.back().script != 0) {
            begin(false, 0);
        } else {
            runs.back().text += c;
        }
    }
    return runs;
}

void selectFont(cairo_t* cairo, const Run& run, const TextLook& look) {
    cairo_select_font_face(cairo, run.italic ? kSymbolFont : kTextFont,
                           run.italic ? CAIRO_FONT_SLANT_ITALIC : CAIRO_FONT_SLANT_NORMAL,
                           look.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo, run.script == 0 ? look.size : look.size * kScriptSize);
}

double advance(cairo_t* cairo, const Run& run, const TextLook& look) {
    selectFont(cairo, run, look);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo, run.text.c_str(), &extents);
    // A slanted letter leans over its own width, so a script after it needs a little room.
    return extents.x_advance + (run.italic ? 0.04 * look.size : 0.0);
}

double liftOf(const Run& run, const TextLook& look) {
    return run.script == 0 ? 0.0 : run.script < 0 ? 0.22 * look.size : -0.36 * look.size;
}

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    }
    return result;
}

int byteOf(double share) {
    return static_cast<int>(std::lround(255.0 * share));
}

void appendSvgText(std::string& out_svg, double x, double y, const std::vector<Run>& runs, const TextLook& look,
                   TextAlign align) {
    out_svg +=
        fmt::format(R"(<text x="{:.2f}" y="{:.2f}" font-size="{:.2f}" fill="#{:02x}{:02x}{:02x}" text-anchor="{}"{}>)",
                    x, y, look.size, byteOf(look.color.r), byteOf(look.color.g), byteOf(look.color.b),
                    align == TextAlign::Left     ? "start"
                    : align == TextAlign::Center ? "middle"
                                                 : "end",
                    look.bold ? R"( font-weight="bold")" : "");
    double lift = 0.0;
    for (const Run& run : runs) {
        if (run.text.empty()) {
            continue;
        }
        const double rise = liftOf(run, look) - lift;
        lift += rise;
        out_svg += "<tspan";
        out_svg += rise != 0.0 ? fmt::format(R"( dy="{:.2f}")", rise) : "";
        out_svg += run.script != 0 ? fmt::format(R"( font-size="{:.2f}")", kScriptSize * look.size) : "";
        out_svg +=
            run.italic ? fmt::format(R"( font-family="{}, Georgia, serif" font-style="italic")", kSymbolFont) : "";
        out_svg += ">" + escaped(run.text) + "</tspan>";
    }
    out_svg += "</text>\n";
}

const cairo_user_data_key_t kSvgTextKey{};

} // namespace

void writeTextAsSvg(cairo_t* cairo, std::string& out_svg) {
    cairo_set_user_data(cairo, &kSvgTextKey, &out_svg, nullptr);
}

void prepareText(cairo_t* cairo) {
    cairo_font_options_t* options = cairo_font_options_create();
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_set_font_options(cairo, options);
    cairo_font_options_destroy(options);
}

double textWidth(cairo_t* cairo, std::string_view markup, const TextLook& look) {
    double width = 0.0;
    for (const Run& run : parseRuns(markup)) {
        width += advance(cairo, run, look);
    }
    return width;
}

void drawText(cairo_t* cairo, double x, double y, std::string_view markup, const TextLook& look, TextAlign align) {
    const std::vector<Run> runs = parseRuns(markup);
    if (void* svg = cairo_get_user_data(cairo, &kSvgTextKey)) {
        appendSvgText(*static_cast<std::string*>(svg), x, y, runs, look, align);
        return;
    }
    const double shift = align == TextAlign::Left ? 0.0 : align == TextAlign::Center ? 0.5 : 1.0;
    double pen = x - shift * textWidth(cairo, markup, look);
    cairo_set_source_rgb(cairo, look.color.r, look.color.g, look.color.b);
    for (const Run& run : runs) {
        const double width = advance(cairo, run, look);
        cairo_move_to(cairo, pen, y + liftOf(run, look));
        cairo_show_text(cairo, run.text.c_str());
        pen += width;
    }
}

} // namespace elastoon
