// Pictures in linear light, and their way to 8 bits and to PNG files.
#pragma once

#include "elastoon/math.h"
#include "elastoon/result.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace elastoon {

/// Linear light, red green blue; 1 is the white of the screen.
using Color = glm::vec3;

struct PictureSize {
    int width = 960;
    int height = 540;

    [[nodiscard]] std::size_t pixelCount() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
    friend bool operator==(const PictureSize&, const PictureSize&) = default;
};

/// Rows from the top, pixels from the left.
struct Picture {
    PictureSize size;
    std::vector<Color> pixels;

    [[nodiscard]] Color& at(int x, int y) { return pixels[index(x, y)]; }
    [[nodiscard]] const Color& at(int x, int y) const { return pixels[index(x, y)]; }
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) + static_cast<std::size_t>(x);
    }
};

[[nodiscard]] Picture makePicture(PictureSize size, const Color& color = Color(0.0F));

/// Linear light of an sRGB colour (0..1).
[[nodiscard]] Color linearFromSrgb(const Vec3& srgb);

/// Three bytes for each pixel, sRGB, highlights rolled off softly.
[[nodiscard]] std::vector<std::uint8_t> toRgb8(const Picture& picture);

/// Writes the picture whole or not at all.
Status writePng(const std::string& path, const Picture& picture);

} // namespace elastoon
