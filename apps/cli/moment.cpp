// See moment.h.
#include "moment.h"

#include <glm/common.hpp>

#include <cmath>
#include <limits>

namespace elastoon {

namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr std::uint32_t kPixelUse = 10;

int firstOf(int samples) {
    return std::min(samples, std::max(4, samples / 4));
}

float brightness(const Color& color) {
    return 0.25F * color.r + 0.6F * color.g + 0.15F * color.b;
}

std::vector<Thing> joined(std::span<const Thing> things, const std::vector<Thing>& solids) {
    std::vector<Thing> all(things.begin(), things.end());
    all.insert(all.end(), solids.begin(), solids.end());
    return all;
}

} // namespace

Moment::Moment(const Backdrop& backdrop, std::span<const Thing> things, const LayerOptions& options)
    : backdrop_(backdrop),
      all_(joined(things, backdrop.solids)),
      scene_(*backdrop.meshes, backdrop.setting, all_),
      shader_(backdrop.setting, scene_, things.size()),
      count_(things.size()),
      bounds_(scene_.bounds().data(), count_),
      samples_(options.samples > 0 ? options.samples : backdrop.options.samples),
      shadows_(options.shadows),
      seed_(options.seed) {}

/// Whether a thing's bound lies within a pixel and a half of the ray.
bool Moment::coverable(const Ray& ray) const {
    return std::any_of(bounds_.begin(), bounds_.end(), [&](const Bound& bound) {
        const glm::vec3 to = bound.centre - ray.origin;
        const float along = glm::dot(to, ray.direction);
        const glm::vec3 aside = to - ray.direction * along;
        const float radius = bound.radius + 1.5F * std::fabs(along) * backdrop_.eye.step;
        return along > -bound.radius && glm::dot(aside, aside) < radius * radius;
    });
}

Work Moment::workAt(int x, int y) const {
    if (coverable(backdrop_.eye.through(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F))) {
        return Work::Full;
    }
    const Seen& seen = backdrop_.seen[backdrop_.picture.index(x, y)];
    if (!shadows_ || seen.normal == glm::vec3(0.0F)) {
        return Work::None;
    }
    switch (reachOf(backdrop_.setting, shader_.first(), seen.point, seen.normal)) {
    case Reach::None:
        return Work::None;
    case Reach::Far:
        return Work::Far;
    case Reach::Near:
        break;
    }
    return seen.plain ? Work::Soft : Work::Full;
}

std::vector<Work> Moment::plan() const {
    const PictureSize size = backdrop_.size;
    std::vector<Work> plan(size.pixelCount(), Work::None);
    backdrop_.forRows(0, size.height, [&](int y) {
        for (int x = 0; x < size.width; ++x) {
            plan[backdrop_.picture.index(x, y)] = workAt(x, y);
        }
    });
    return plan;
}

/// Share of the background's light that is left at a plain pixel.
Color Moment::shareAt(const Seen& seen, std::uint32_t seed) const {
    if (!shadows_ || seen.normal == glm::vec3(0.0F)) {
        return Color(1.0F);
    }
    const Color share = shader_.softShare(seen.point, seen.normal, seed, static_cast<std::uint32_t>(samples_));
    return glm::mix(Color(1.0F), share, seen.presence);
}

/// One line of sight. In a plain pixel it only tells the things' part.
LayerPixel Moment::sample(const Ray& ray, bool plain, SampleKey key) const {
    LayerPixel light;
    const SettingHit behind = meetSetting(backdrop_.setting, ray);
    ThingHit hit;
    if (!scene_.nearest(ray, behind.distance, hit)) {
        light.around = plain ? Color(0.0F) : shader_.settingColor(behind, ray, key);
    } else if (hit.thing < count_) {
        light.things = shader_.thingColor(hit, ray, key);
        light.coverage = 1.0F;
    } else if (!plain) {
        light.around = shader_.thingColor(hit, ray, key);
    }
    return light;
}

/// The mean of some lines of sight, and where they differ, of all of them.
LayerPixel Moment::sampled(int x, int y, bool plain, std::uint32_t seed) const {
    constexpr float kEven = 0.05F; // contrast that needs no more samples
    LayerPixel sum;
    float least = kFar, most = 0.0F;
    int done = 0;
    while (done < samples_ && (done == 0 || most - least > kEven * (most + 0.05F))) {
        const int end = done == 0 ? firstOf(samples_) : samples_;
        for (; done < end; ++done) {
            const auto index = static_cast<std::uint32_t>(done);
            const glm::vec2 unit = sampling::point(sampling::hash(seed, kPixelUse), index);
            const Ray ray = backdrop_.eye.through(static_cast<float>(x) + 0.5F + 0.85F * sampling::tent(unit.x),
                                                  static_cast<float>(y) + 0.5F + 0.85F * sampling::tent(unit.y));
            const LayerPixel light = sample(ray, plain, {seed, index});
            sum.things += light.things;
            sum.around += light.around;
            sum.coverage += light.coverage;
            const float bright = brightness(light.things + light.around) + light.coverage * 0.1F;
            least = std::min(least, bright);
            most = std::max(most, bright);
        }
    }
    const float share = 1.0F / static_cast<float>(done);
    return {sum.things * share, sum.coverage * share, sum.around * share};
}

Color Moment::settingAt(int x, int y) const {
    const Ray ray = backdrop_.eye.through(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
    return shader_.settingColor(meetSetting(backdrop_.setting, ray), ray, {});
}

LayerPixel Moment::pixel(Work work, int x, int y) const {
    const std::size_t index = backdrop_.picture.index(x, y);
    const Seen& seen = backdrop_.seen[index];
    const std::uint32_t seed = sampling::hash(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)) ^ seed_;
    const bool plain = seen.plain || !shadows_;
    LayerPixel pixel;
    if (work == Work::Full) {
        pixel = sampled(x, y, plain, seed);
    }
    if (work != Work::Full || (plain && pixel.coverage < 1.0F)) {
        const Color share = work == Work::None ? Color(1.0F) : shareAt(seen, seed);
        pixel.around = backdrop_.picture.pixels[index] * share * (1.0F - pixel.coverage);
    }
    return pixel;
}

} // namespace elastoon
