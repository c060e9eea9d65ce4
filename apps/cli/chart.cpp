// See chart.h.
#include "chart.h"

#include "chart_drawing.h"
#include "chart_text.h"
#include "output_file.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>

namespace elastoon {

namespace {

constexpr double kPixelsPerPoint = 2.0; // of a PNG

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
    static_cast<std::string*>(bytes)->append(data, data + length);
    return CAIRO_STATUS_SUCCESS;
}

/// Draws and says what went wrong, if anything: cairo keeps the first failure.
cairo_status_t drawOn(cairo_surface_t* surface, const Chart& chart, double scale, std::string* out_svg_text = nullptr) {
    cairo_t* cairo = cairo_create(surface);
    cairo_scale(cairo, scale, scale);
    if (out_svg_text != nullptr) {
        writeTextAsSvg(cairo, *out_svg_text);
    }
    drawChart(cairo, chart);
    const cairo_status_t status = cairo_status(cairo);
    cairo_destroy(cairo);
    return status;
}

cairo_status_t finish(cairo_surface_t* surface, cairo_status_t drawn) {
    cairo_surface_finish(surface);
    return drawn != CAIRO_STATUS_SUCCESS ? drawn : cairo_surface_status(surface);
}

cairo_status_t pngBytes(const Chart& chart, std::string& out_bytes) {
    const int width = static_cast<int>(std::lround(chart.width * kPixelsPerPoint));
    const int height = static_cast<int>(std::lround(chart.height * kPixelsPerPoint));
    const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height), cairo_surface_destroy);
    const cairo_status_t drawn = drawOn(surface.get(), chart, kPixelsPerPoint);
    return drawn != CAIRO_STATUS_SUCCESS ? drawn : cairo_surface_write_to_png_stream(surface.get(), append, &out_bytes);
}

/// cairo numbers its groups through the life of the process; without the numbers the same chart is the same file.
void dropSurfaceNumbers(std::string& svg) {
    constexpr std::string_view kKey = "id=\"surface";
    for (std::size_t at = svg.find(kKey); at != std::string::npos; at = svg.find(kKey, at + kKey.size())) {
        const std::size_t digits = at + kKey.size();
        svg.erase(digits, svg.find('"', digits) - digits);
    }
}

/// Leaves two decimals of each number: a hundredth of a point cannot be seen, and the file is half as large.
std::string roundedNumbers(const std::string& svg) {
    constexpr std::size_t kDecimals = 2;
    const auto digit = [&](std::size_t at) { return at < svg.size() && svg[at] >= '0' && svg[at] <= '9'; };
    std::string result;
    for (std::size_t at = 0; at < svg.size();) {
        std::size_t end = at;
        while (digit(end)) {
            ++end;
        }
        const std::size_t point = end;
        if (end > at && svg[end] == '.') {
            for (++end; digit(end);) {
                ++end;
            }
        }
        if (end > point + 1 + kDecimals) {
            result += fmt::format("{:.{}f}", std::stod(svg.substr(at, end - at)), kDecimals);
        } else {
            end = std::max(end, at + 1);
            result.append(svg, at, end - at);
        }
        at = end;
    }
    return result;
}

cairo_status_t svgBytes(const Chart& chart, std::string& out_bytes) {
    const Surface surface(cairo_svg_surface_create_for_stream(append, &out_bytes, chart.width, chart.height),
                          cairo_surface_destroy);
    std::string text;
    const cairo_status_t status = finish(surface.get(), drawOn(surface.get(), chart, 1.0, &text));
    dropSurfaceNumbers(out_bytes);
    out_bytes = roundedNumbers(out_bytes);
    const std::size_t end = out_bytes.rfind("</svg>");
    if (end != std::string::npos) {
        out_bytes.insert(end, "<g font-family=\"DejaVu Sans, Verdana, sans-serif\">\n" + text + "</g>\n");
    }
    return status;
}

cairo_status_t pdfBytes(const Chart& chart, std::string& out_bytes) {
    const Surface surface(cairo_pdf_surface_create_for_stream(append, &out_bytes, chart.width, chart.height),
                          cairo_surface_destroy);
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
    return finish(surface.get(), drawOn(surface.get(), chart, 1.0));
}

Status checked(const Chart& chart) {
    for (const ChartAxis* axis : {&chart.x, &chart.y}) {
        const bool finite = std::isfinite(axis->from) && std::isfinite(axis->to);
        if (!finite || !(axis->from < axis->to) || (axis->logarithmic && !(axis->from > 0.0))) {
            return Error{fmt::format("a chart's axis goes from {} to {}; it must rise{}", axis->from, axis->to,
                                     axis->logarithmic ? " and be above 0" : ""),
                         axis->label};
        }
    }
    if (!(chart.width >= 100.0 && chart.width <= 10000.0 && chart.height >= 100.0 && chart.height <= 10000.0)) {
        return Error{fmt::format("a chart of {} x {} points; 100 to 10000 are possible", chart.width, chart.height),
                     chart.title};
    }
    return success();
}

} // namespace

Vec3 chartColor(std::size_t index) {
    static constexpr std::array<Vec3, 6> kColors{Vec3{0.086, 0.396, 0.702}, Vec3{0.882, 0.322, 0.141},
                                                 Vec3{0.106, 0.565, 0.427}, Vec3{0.518, 0.310, 0.690},
                                                 Vec3{0.835, 0.596, 0.059}, Vec3{0.345, 0.376, 0.416}};
    return kColors[index % kColors.size()];
}

Status writeChart(const Chart& chart, const std::string& path) {
    Status usable = checked(chart);
    if (!usable) {
        return usable;
    }
    std::string ending = std::filesystem::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    std::string bytes;
    cairo_status_t status = CAIRO_STATUS_SUCCESS;
    if (ending == ".png") {
        status = pngBytes(chart, bytes);
    } else if (ending == ".svg") {
        status = svgBytes(chart, bytes);
    } else if (ending == ".pdf") {
        status = pdfBytes(chart, bytes);
    } else {
        return Error{fmt::format("a chart cannot end in '{}'; .png, .svg or .pdf can", ending), path};
    }
    if (status != CAIRO_STATUS_SUCCESS) {
        return Error{fmt::format("cannot draw the chart: {}", cairo_status_to_string(status)), path};
    }
    return writeWhole(path, bytes);
}

} // namespace elastoon
