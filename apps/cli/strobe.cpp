// See strobe.h.
#include "strobe.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace elastoon {

namespace {

constexpr float kTrailWeight = 0.11F;
constexpr int kTrailSamples = 8; // they are too faint to show noise

/// Ghosts laid one over the other: their light times their coverage, and the coverage.
struct Sheet {
    Picture paint;
    std::vector<float> covered;
};

Sheet makeSheet(PictureSize size) {
    return {makePicture(size), std::vector<float>(size.pixelCount(), 0.0F)};
}

/// Lays a moment on the sheet, hiding what was there. `weight` below 1 washes it out towards the background.
void layThings(Sheet& sheet, const Picture& background, const Layer& layer, float weight) {
    for (int y = layer.top; y < layer.top + layer.height; ++y) {
        for (int x = layer.left; x < layer.left + layer.width; ++x) {
            const LayerPixel& pixel = layer.at(x, y);
            const std::size_t index = background.index(x, y);
            const Color pale = glm::mix(background.pixels[index] * pixel.coverage, pixel.things, weight);
            sheet.paint.pixels[index] = sheet.paint.pixels[index] * (1.0F - pixel.coverage) + pale;
            sheet.covered[index] = sheet.covered[index] * (1.0F - pixel.coverage) + pixel.coverage;
        }
    }
}

/// Keeps the darkest of the moments' shadows: where two fall it is no darker than in either.
void layShadow(Picture& shade, const Picture& background, const Layer& layer, float weight) {
    for (int y = layer.top; y < layer.top + layer.height; ++y) {
        for (int x = layer.left; x < layer.left + layer.width; ++x) {
            const LayerPixel& pixel = layer.at(x, y);
            const float rest = 1.0F - pixel.coverage;
            if (rest > 0.0F) {
                const std::size_t index = background.index(x, y);
                const Color share = glm::min(pixel.around / (background.pixels[index] * rest), Color(1.0F));
                const Color shadow = glm::mix(Color(1.0F), share, weight);
                shade.pixels[index] = glm::min(shade.pixels[index], shadow);
            }
        }
    }
}

/// How far the shape reaches along a unit direction.
double halfExtent(const Shape& shape, const Pose& pose, const Vec3& direction) {
    const Vec3 in_shape = glm::transpose(linearOf(pose)) * direction;
    return glm::dot(in_shape, shape.vertices()[shape.supportVertex(in_shape)]);
}

/// Distance of two poses over the distance at which they would touch, along the line between them.
double clearance(const Shape& shape, const Pose& a, const Pose& b) {
    const Vec3 apart = b.position - a.position;
    const double distance = glm::length(apart);
    if (distance == 0.0) {
        return 0.0;
    }
    const Vec3 direction = apart / distance;
    return distance / (halfExtent(shape, a, direction) + halfExtent(shape, b, -direction));
}

} // namespace

std::vector<bool> keyGhosts(const Shape& shape, std::span<const Pose> poses, const Vec3& up) {
    constexpr double kRoomForExtremes = 0.35, kRoom = 0.78; // of the distance at which two ghosts would just touch
    constexpr double kSquashed = 0.95;
    std::vector<bool> keys(poses.size(), false);
    const auto keepIfClear = [&](std::size_t index, double room) {
        for (std::size_t i = 0; i < poses.size(); ++i) {
            if (keys[i] && clearance(shape, poses[i], poses[index]) < room) {
                return;
            }
        }
        keys[index] = true;
    };
    const auto height = [&](std::size_t i) { return glm::dot(poses[i].position, up); };
    if (!poses.empty()) {
        keys.front() = keys.back() = true;
    }
    for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
        const double s = poses[i].stretch;
        if (s < kSquashed && s <= poses[i - 1].stretch && s < poses[i + 1].stretch) {
            keepIfClear(i, kRoomForExtremes);
        }
    }
    for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
        if (height(i) >= height(i - 1) && height(i) > height(i + 1)) {
            keepIfClear(i, kRoom);
        }
    }
    for (std::size_t i = 0; i < poses.size(); ++i) {
        keepIfClear(i, kRoom);
    }
    return keys;
}

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
    constexpr float kPalest = 0.48F;
    if (index + 1 >= count) {
        return 1.0F;
    }
    const float age = static_cast<float>(index) / static_cast<float>(count - 1);
    return kPalest + (0.92F - kPalest) * age;
}

Picture strobePicture(const Tracer& tracer, std::span<const Ghost> ghosts,
                      const std::function<bool(std::size_t)>& step) {
    const Picture& background = tracer.background();
    Picture shade = makePicture(background.size, Color(1.0F));
    Sheet trail = makeSheet(background.size), keys = makeSheet(background.size);
    for (std::size_t i = 0; i < ghosts.size(); ++i) {
        const LayerOptions options = ghosts[i].trail ? LayerOptions{kTrailSamples, false} : LayerOptions{};
        const Layer layer = tracer.layer(ghosts[i].things, options);
        if (ghosts[i].trail) {
            layThings(trail, background, layer, 1.0F);
        } else {
            layShadow(shade, background, layer, ghosts[i].weight);
            layThings(keys, background, layer, ghosts[i].weight);
        }
        if (step && !step(i)) {
            break;
        }
    }
    Picture picture = background;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        Color& pixel = picture.pixels[i];
        pixel *= shade.pixels[i];
        pixel = pixel * (1.0F - kTrailWeight * trail.covered[i]) + kTrailWeight * trail.paint.pixels[i];
        pixel = pixel * (1.0F - keys.covered[i]) + keys.paint.pixels[i];
    }
    return picture;
}

} // namespace elastoon
