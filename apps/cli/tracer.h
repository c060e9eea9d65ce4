// Pictures of things in a setting. What cannot change is kept: a moment costs only the pixels that its things, their
// shadows and their nearness to the ground can touch.
#pragma once

#include "camera.h"
#include "picture.h"
#include "ray_scene.h"
#include "setting.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace elastoon {

/// What a moment's things do to one pixel.
struct LayerPixel {
    Color things{0.0F};    ///< light of the things, times their coverage
    float coverage = 0.0F; ///< share of the pixel that they cover
    Color around{0.0F};    ///< light of the rest of the pixel, in their shadow, times its share
};

/// A rectangle of the picture, all that a moment can change. Elsewhere the background shows.
struct Layer {
    int left = 0, top = 0, width = 0, height = 0;
    std::vector<LayerPixel> pixels;

    [[nodiscard]] const LayerPixel& at(int x, int y) const {
        return pixels[static_cast<std::size_t>(y - top) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x - left)];
    }
};

struct TraceOptions {
    int samples = 16; ///< most lines of sight for a pixel; even pixels take a quarter of them
    int threads = 0;  ///< 0: all processors. The picture does not depend on it.
};

/// How a layer is made.
struct LayerOptions {
    int samples = 0;     ///< 0: as the tracer's options say
    bool shadows = true; ///< else the things alone: `around` is the background
    std::uint32_t seed = 0; ///< another gives other noise: for pictures that are averaged
};

class Tracer {
public:
    static Result<Tracer> create(PictureSize size, const TraceOptions& options = {});
    Tracer(Tracer&&) noexcept;
    Tracer& operator=(Tracer&&) noexcept;
    ~Tracer();

    /// A mesh that things can name.
    std::size_t addMesh(DrawnMesh mesh);
    /// What stands still: the setting, and solids in it. Draws the background anew.
    void place(const Setting& setting, const Camera& camera, std::span<const Thing> solids);

    /// The setting and the solids without any thing in front.
    [[nodiscard]] const Picture& background() const;
    /// The things of a moment over the background.
    [[nodiscard]] Layer layer(std::span<const Thing> things, const LayerOptions& options = {}) const;
    /// The background with the things of a moment.
    [[nodiscard]] Picture picture(std::span<const Thing> things, const LayerOptions& options = {}) const;

private:
    struct Impl;
    explicit Tracer(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

} // namespace elastoon
