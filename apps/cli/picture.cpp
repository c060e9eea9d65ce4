// See picture.h.
#include "picture.h"

#include "output_file.h"

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace elastoon {

namespace {

double linearFromSrgb(double value) {
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// Straight up to the knee, then bent so that no light burns out.
float rollOff(float value) {
    constexpr float kKnee = 0.80F;
    if (value <= kKnee) {
        return std::max(value, 0.0F);
    }
    const float over = (value - kKnee) / (1.0F - kKnee);
    return kKnee + (1.0F - kKnee) * over / (1.0F + 0.75F * over);
}

/// Light of each of the 256 byte values. Rounded to float, so that the last bit of the math library's pow() does not
/// show.
std::array<float, 256> makeLevels() {
    std::array<float, 256> levels{};
    for (std::size_t i = 0; i < levels.size(); ++i) {
        levels[i] = static_cast<float>(linearFromSrgb(static_cast<double>(i) / 255.0));
    }
    return levels;
}

/// Bayer's 4 x 4 thresholds: a gentle gradient shows no bands, and the file stays small.
float threshold(std::size_t x, std::size_t y) {
    constexpr std::array<std::uint8_t, 16> kOrder{0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
    return (static_cast<float>(kOrder[(y % 4) * 4 + x % 4]) + 0.5F) / 16.0F;
}

std::uint8_t toByte(float light, float threshold) {
    static const std::array<float, 256> kLevels = makeLevels();
    const float level = rollOff(light);
    const auto above = std::upper_bound(kLevels.begin(), kLevels.end(), level);
    if (above == kLevels.end()) {
        return 255;
    }
    const auto below = above - 1; // the first level is 0: never the end
    const float share = (level - *below) / (*above - *below);
    return static_cast<std::uint8_t>((below - kLevels.begin()) + (share > threshold ? 1 : 0));
}

} // namespace

Picture makePicture(PictureSize size, const Color& color) {
    return {size, std::vector<Color>(size.pixelCount(), color)};
}

Color linearFromSrgb(const Vec3& srgb) {
    return {static_cast<float>(linearFromSrgb(srgb.x)), static_cast<float>(linearFromSrgb(srgb.y)),
            static_cast<float>(linearFromSrgb(srgb.z))};
}

std::vector<std::uint8_t> toRgb8(const Picture& picture) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(picture.pixels.size() * 3);
    const auto width = static_cast<std::size_t>(picture.size.width);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const float limit = threshold(i % width, i / width);
        for (int channel = 0; channel < 3; ++channel) {
            bytes.push_back(toByte(picture.pixels[i][channel], limit));
        }
    }
    return bytes;
}

Status writePng(const std::string& path, const Picture& picture) {
    auto output = OutputFile::create(path);
    if (!output) {
        return output.error();
    }
    const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, picture.size.width, picture.size.height),
        &cairo_surface_destroy);
    if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) {
        return Error{cairo_status_to_string(cairo_surface_status(surface.get())), path};
    }
    const std::vector<std::uint8_t> bytes = toRgb8(picture);
    const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get()));
    const auto width = static_cast<std::size_t>(picture.size.width);
    unsigned char* data = cairo_image_surface_get_data(surface.get());
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const std::uint32_t word = (std::uint32_t{bytes[3 * i]} << 16) | (std::uint32_t{bytes[3 * i + 1]} << 8) |
                                   std::uint32_t{bytes[3 * i + 2]};
        unsigned char* to = data + (i / width) * stride + (i % width) * sizeof word;
        std::copy_n(reinterpret_cast<const unsigned char*>(&word), sizeof word, to);
    }
    cairo_surface_mark_dirty(surface.get());
    const cairo_status_t written = cairo_surface_write_to_png(surface.get(), output.value().temporaryPath().c_str());
    if (written != CAIRO_STATUS_SUCCESS) {
        return Error{fmt::format("cannot write the picture: {}", cairo_status_to_string(written)), path};
    }
    return output.value().commit();
}

} // namespace elastoon
