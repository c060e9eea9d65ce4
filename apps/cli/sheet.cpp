// See sheet.h.
#include "sheet.h"

#include "chart_text.h"
#include "progress.h"
#include "show.h"
#include "strobe.h"

#include <cairo.h>
#include <glm/common.hpp>

#include <algorithm>
#include <memory>

namespace elastoon {

namespace {

constexpr float kPalestGhost = 0.10F, kStrongestGhost = 0.34F;
const Color kPaper(0.94F);

/// Between cells and around them.
int gapOf(const SheetOptions& options) {
    return std::max(2, options.size.width / 320);
}

Picture cellPicture(const Show& show, double time, const SheetOptions& options) {
    if (options.ghosts == 0) {
        return show.tracer().picture(show.bodiesAt(time));
    }
    std::vector<Ghost> ghosts;
    for (int i = options.ghosts; i > 0; --i) {
        const double before = time - i * options.ghost_every;
        if (before >= 0.0) {
            const float age = static_cast<float>(i) / static_cast<float>(options.ghosts + 1);
            ghosts.push_back({show.bodiesAt(before), glm::mix(kStrongestGhost, kPalestGhost, age)});
        }
    }
    ghosts.push_back({show.bodiesAt(time)});
    return strobePicture(show.tracer(), ghosts);
}

void lay(Picture& sheet, const Picture& cell, int left, int top) {
    for (int y = 0; y < cell.size.height; ++y) {
        std::copy_n(&cell.at(0, y), cell.size.width, &sheet.at(left, top + y));
    }
}

struct DestroySurface {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct DestroyContext {
    void operator()(cairo_t* cairo) const { cairo_destroy(cairo); }
};

/// Writes the label into the lower left corner of a cell.
void label(Picture& cell, const std::string& text) {
    const PictureSize size = cell.size;
    const double points = std::clamp(size.height / 14.0, 8.0, 20.0);
    const std::unique_ptr<cairo_surface_t, DestroySurface> surface(
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, size.width, size.height));
    const std::unique_ptr<cairo_t, DestroyContext> cairo(cairo_create(surface.get()));
    prepareText(cairo.get());
    drawText(cairo.get(), 0.5 * points, size.height - 0.5 * points, text, {points, false, Vec3(1.0)});
    cairo_surface_flush(surface.get());
    const unsigned char* bytes = cairo_image_surface_get_data(surface.get());
    const int stride = cairo_image_surface_get_stride(surface.get());
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) { // white on black: any channel is the ink
            const float ink = 0.75F * static_cast<float>(bytes[y * stride + 4 * x]) / 255.0F;
            cell.at(x, y) = glm::mix(cell.at(x, y), Color(0.02F), ink);
        }
    }
}

} // namespace

PictureSize cellSize(const SheetOptions& options) {
    const int gap = gapOf(options);
    return {(options.size.width - gap * (options.columns + 1)) / options.columns,
            (options.size.height - gap * (options.rows + 1)) / options.rows};
}

Result<Rendered> renderSheet(const Scene& scene, const Timeline& timeline, const SheetOptions& options,
                             const std::string& path) {
    const PictureSize cell = cellSize(options);
    const auto cells = static_cast<std::size_t>(options.columns) * static_cast<std::size_t>(options.rows);
    if (options.times.empty() || options.times.size() > cells || std::min(cell.width, cell.height) < kLeastCell) {
        return Error{"there is nothing to draw, or no room for it", path};
    }
    const ShowSpan span{options.times.front(), options.times.back(), Vec3(0.0)};
    auto made = Show::create(scene, timeline, span, cell, {options.samples, options.threads});
    if (!made) {
        return made.error();
    }
    Show& show = made.value();
    const int gap = gapOf(options);
    Picture sheet = makePicture(options.size, kPaper);
    Progress progress("cells", static_cast<double>(options.times.size()));
    for (std::size_t i = 0; i < options.times.size(); ++i) {
        show.setTime(options.times[i]);
        Picture picture = cellPicture(show, options.times[i], options);
        if (i < options.labels.size()) {
            label(picture, options.labels[i]);
        }
        const int column = static_cast<int>(i) % options.columns, row = static_cast<int>(i) / options.columns;
        lay(sheet, picture, gap + column * (cell.width + gap), gap + row * (cell.height + gap));
        if (interrupted()) {
            return Error{"interrupted; nothing was written", path};
        }
        progress.at(static_cast<double>(i + 1));
    }
    const auto written = writePng(path, sheet);
    if (!written) {
        return written.error();
    }
    return Rendered{options.size, static_cast<int>(options.times.size())};
}

} // namespace elastoon
