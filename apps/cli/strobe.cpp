// See strobe.h.
#include "strobe.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace elastoon {

namespace {

/// The picture while ghosts are laid on it.
struct Canvas {
    Picture shade;              // share of the background's light that is left
    Picture paint;              // light of the ghosts, times their coverage
    std::vector<float> covered; // 0..1
};

void layGhost(Canvas& canvas, const Picture& background, const Layer& layer, float weight) {
    for (int y = layer.top; y < layer.top + layer.height; ++y) {
        for (int x = layer.left; x < layer.left + layer.width; ++x) {
            const LayerPixel& pixel = layer.at(x, y);
            const std::size_t index = background.index(x, y);
            const Color& behind = background.pixels[index];
            const float rest = 1.0F - pixel.coverage;
            if (rest > 0.0F) {
                const Color share = glm::min(pixel.around / (behind * rest), Color(1.0F));
                // Its shadow counts as far as it is seen beside the ghost.
                const Color shadow = glm::mix(Color(1.0F), share, weight * rest);
                canvas.shade.pixels[index] = glm::min(canvas.shade.pixels[index], shadow);
            }
            const Color pale = glm::mix(behind * pixel.coverage, pixel.things, weight);
            canvas.paint.pixels[index] = canvas.paint.pixels[index] * rest + pale;
            canvas.covered[index] = canvas.covered[index] * rest + pixel.coverage;
        }
    }
}

} // namespace

std::vector<double> strobeTimes(const SceneStrobe& strobe, double end) {
    const double to = strobe.to < 0.0 ? end : strobe.to;
    std::vector<double> times;
    for (std::size_t i = 0; strobe.every > 0.0; ++i) {
        const double t = strobe.from + static_cast<double>(i) * strobe.every; // no sum: no error grows
        if (t > to + 1e-9 * strobe.every) {
            break;
        }
        times.push_back(t);
    }
    return times;
}

float ghostWeight(std::size_t index, std::size_t count) {
    constexpr float kPalest = 0.30F;
    if (index + 1 >= count) {
        return 1.0F;
    }
    const float age = static_cast<float>(index) / static_cast<float>(count - 1);
    return kPalest + (0.90F - kPalest) * age;
}

Picture strobePicture(const Tracer& tracer, std::span<const Ghost> ghosts,
                      const std::function<bool(std::size_t)>& step) {
    const Picture& background = tracer.background();
    Canvas canvas{makePicture(background.size, Color(1.0F)), makePicture(background.size),
                  std::vector<float>(background.pixels.size(), 0.0F)};
    for (std::size_t i = 0; i < ghosts.size(); ++i) {
        layGhost(canvas, background, tracer.layer(ghosts[i].things), ghosts[i].weight);
        if (step && !step(i)) {
            break;
        }
    }
    Picture picture = background;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        picture.pixels[i] =
            background.pixels[i] * canvas.shade.pixels[i] * (1.0F - canvas.covered[i]) + canvas.paint.pixels[i];
    }
    return picture;
}

} // namespace elastoon
