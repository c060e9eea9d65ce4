// See tracer.h.
#include "tracer.h"

#include "sampling.h"
#include "shading.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <thread>

namespace elastoon {

namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr std::uint32_t kPixelUse = 10;

/// The camera in single precision about the setting's origin.
struct Eye {
    glm::vec3 origin{0.0F}, right{1.0F, 0.0F, 0.0F}, up{0.0F, 1.0F, 0.0F}, forward{0.0F, 0.0F, -1.0F};
    float step = 1.0F; // of a pixel at distance 1
    float centre_x = 0.0F, centre_y = 0.0F;

    [[nodiscard]] Ray through(float x, float y) const {
        return {origin, glm::normalize(forward + right * ((x - centre_x) * step) + up * ((centre_y - y) * step))};
    }
};

Eye eyeOf(const Camera& camera, const Setting& setting, PictureSize size) {
    Eye eye;
    eye.origin = setting.local(camera.eye);
    eye.right = glm::vec3(camera.right);
    eye.up = glm::vec3(camera.up);
    eye.forward = glm::vec3(camera.forward);
    eye.step = static_cast<float>(2.0 * camera.tan_half_height / size.height);
    eye.centre_x = static_cast<float>(size.width) * 0.5F;
    eye.centre_y = static_cast<float>(size.height) * 0.5F;
    return eye;
}

/// What the middle of a pixel shows of the background: tells where things can matter.
struct Seen {
    glm::vec3 point{0.0F};
    glm::vec3 normal{0.0F}; ///< zero: the backdrop
};

int firstOf(int samples) {
    return std::min(samples, std::max(4, samples / 4));
}

float brightness(const Color& color) {
    return 0.25F * color.r + 0.6F * color.g + 0.15F * color.b;
}

} // namespace

struct Tracer::Impl {
    PictureSize size;
    TraceOptions options;
    std::optional<MeshStore> meshes;
    Setting setting;
    Eye eye;
    std::vector<Thing> solids;
    Picture background;
    std::vector<Seen> seen;

    /// Each row by one thread. (Not by TBB: Embree's device holds all of TBB at one thread.)
    template <class Row>
    void forRows(int begin, int end, const Row& row) const {
        std::atomic<int> next = begin;
        const auto work = [&] {
            for (int y = next++; y < end; y = next++) {
                row(y);
            }
        };
        const unsigned processors = std::max(1U, std::thread::hardware_concurrency());
        const unsigned threads = options.threads > 0 ? static_cast<unsigned>(options.threads) : processors;
        std::vector<std::jthread> helpers;
        for (unsigned i = 1; i < threads; ++i) {
            helpers.emplace_back(work);
        }
        work();
    }

    [[nodiscard]] LayerPixel sample(const RayScene& scene, std::size_t thing_count, const Ray& ray,
                                    SampleKey key) const;
    [[nodiscard]] LayerPixel pixel(const RayScene& scene, std::size_t thing_count, int x, int y, int first,
                                   int samples) const;
    [[nodiscard]] Seen seenAt(const RayScene& scene, int x, int y) const;
    [[nodiscard]] std::vector<Reach> touched(const RayScene& scene, std::size_t thing_count) const;
    void drawBackground();
};

/// One line of sight. Things come before the solids in the scene.
LayerPixel Tracer::Impl::sample(const RayScene& scene, std::size_t thing_count, const Ray& ray, SampleKey key) const {
    LayerPixel light;
    const Shader shader(setting, scene);
    const SettingHit behind = meetSetting(setting, ray);
    ThingHit hit;
    if (!scene.nearest(ray, std::min(behind.distance, kFar), hit)) {
        light.around = shader.settingColor(behind, ray, key);
    } else if (hit.thing < thing_count) {
        light.things = shader.thingColor(hit, ray, key);
        light.coverage = 1.0F;
    } else {
        light.around = shader.thingColor(hit, ray, key);
    }
    return light;
}

/// `first` samples, and where they differ, all of them.
LayerPixel Tracer::Impl::pixel(const RayScene& scene, std::size_t thing_count, int x, int y, int first,
                               int samples) const {
    constexpr float kEven = 0.02F; // contrast that needs no more samples
    const std::uint32_t seed = sampling::hash(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
    LayerPixel sum;
    float least = kFar, most = 0.0F;
    int done = 0;
    while (done < samples && (done < first || most - least > kEven * (most + 0.05F))) {
        const int end = done == 0 ? first : samples;
        for (; done < end; ++done) {
            const auto index = static_cast<std::uint32_t>(done);
            const glm::vec2 unit = sampling::point(sampling::hash(seed, kPixelUse), index);
            const Ray ray = eye.through(static_cast<float>(x) + 0.5F + 0.85F * sampling::tent(unit.x),
                                        static_cast<float>(y) + 0.5F + 0.85F * sampling::tent(unit.y));
            const LayerPixel light = sample(scene, thing_count, ray, {seed, index});
            sum.things += light.things;
            sum.around += light.around;
            sum.coverage += light.coverage;
            const float bright = brightness(light.things + light.around);
            least = std::min(least, bright);
            most = std::max(most, bright);
        }
    }
    const float share = 1.0F / static_cast<float>(done);
    return {sum.things * share, sum.coverage * share, sum.around * share};
}

Seen Tracer::Impl::seenAt(const RayScene& scene, int x, int y) const {
    const Ray ray = eye.through(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
    const SettingHit behind = meetSetting(setting, ray);
    ThingHit hit;
    if (scene.nearest(ray, std::min(behind.distance, kFar), hit)) {
        return {hit.point, hit.normal};
    }
    if (behind.kind == SettingHit::Kind::Nothing) {
        return {};
    }
    const bool ground = behind.kind == SettingHit::Kind::Ground;
    return {ray.origin + ray.direction * behind.distance,
            ground ? setting.ground->normal : setting.walls[behind.wall].normal};
}

void Tracer::Impl::drawBackground() {
    const RayScene scene(*meshes, setting, solids);
    background = makePicture(size);
    seen.assign(size.pixelCount(), {});
    forRows(0, size.height, [&](int y) {
        for (int x = 0; x < size.width; ++x) {
            const std::size_t index = background.index(x, y);
            seen[index] = seenAt(scene, x, y);
            background.pixels[index] = pixel(scene, 0, x, y, firstOf(options.samples), options.samples).around;
        }
    });
}

/// Pixels whose middle or a neighbour's middle the things, their shadows or their occlusion can reach.
std::vector<Reach> Tracer::Impl::touched(const RayScene& scene, std::size_t thing_count) const {
    std::vector<Reach> centre(size.pixelCount(), Reach::None);
    const std::span<const Bound> bounds(scene.bounds().data(), thing_count);
    forRows(0, size.height, [&](int y) {
        for (int x = 0; x < size.width; ++x) {
            const std::size_t index = background.index(x, y);
            const Ray ray = eye.through(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
            const Seen& at = seen[index];
            Reach reach = at.normal == glm::vec3(0.0F) ? Reach::None : reachOf(setting, bounds, at.point, at.normal);
            for (std::size_t i = 0; i < bounds.size() && reach != Reach::Near; ++i) {
                const glm::vec3 to = bounds[i].centre - ray.origin;
                const float along = glm::dot(to, ray.direction);
                const glm::vec3 aside = to - ray.direction * along;
                const float radius = bounds[i].radius + along * eye.step;
                if (along > -bounds[i].radius && glm::dot(aside, aside) < radius * radius) {
                    reach = Reach::Near;
                }
            }
            centre[index] = reach;
        }
    });
    std::vector<Reach> out = centre;
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            if (centre[background.index(x, y)] != Reach::Near) {
                continue;
            }
            for (int v = std::max(0, y - 1); v <= std::min(size.height - 1, y + 1); ++v) {
                for (int u = std::max(0, x - 1); u <= std::min(size.width - 1, x + 1); ++u) {
                    out[background.index(u, v)] = Reach::Near;
                }
            }
        }
    }
    return out;
}

Tracer::Tracer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Tracer::Tracer(Tracer&&) noexcept = default;
Tracer& Tracer::operator=(Tracer&&) noexcept = default;
Tracer::~Tracer() = default;

Result<Tracer> Tracer::create(PictureSize size, const TraceOptions& options) {
    auto meshes = MeshStore::create();
    if (!meshes) {
        return meshes.error();
    }
    auto impl = std::make_unique<Impl>();
    impl->size = size;
    impl->options = options;
    impl->meshes.emplace(std::move(meshes).value());
    return Tracer(std::move(impl));
}

std::size_t Tracer::addMesh(DrawnMesh mesh) {
    return impl_->meshes->add(std::move(mesh));
}

void Tracer::place(const Setting& setting, const Camera& camera, std::span<const Thing> solids) {
    impl_->setting = setting;
    impl_->eye = eyeOf(camera, setting, impl_->size);
    impl_->solids.assign(solids.begin(), solids.end());
    impl_->drawBackground();
}

const Picture& Tracer::background() const {
    return impl_->background;
}

Layer Tracer::layer(std::span<const Thing> things, int samples) const {
    std::vector<Thing> all(things.begin(), things.end());
    all.insert(all.end(), impl_->solids.begin(), impl_->solids.end());
    const RayScene scene(*impl_->meshes, impl_->setting, all);
    const std::vector<Reach> active = impl_->touched(scene, things.size());
    const PictureSize size = impl_->size;
    int left = size.width, right = 0, top = size.height, bottom = 0;
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            if (active[impl_->background.index(x, y)] != Reach::None) {
                left = std::min(left, x);
                right = std::max(right, x + 1);
                top = std::min(top, y);
                bottom = y + 1;
            }
        }
    }
    Layer layer;
    if (left >= right) {
        return layer;
    }
    layer.left = left;
    layer.top = top;
    layer.width = right - left;
    layer.height = bottom - top;
    layer.pixels.resize(static_cast<std::size_t>(layer.width) * static_cast<std::size_t>(layer.height));
    const Shader shader(impl_->setting, scene);
    const std::span<const Bound> bounds(scene.bounds().data(), things.size());
    const int most = samples > 0 ? samples : impl_->options.samples;
    impl_->forRows(top, bottom, [&](int y) {
        for (int x = left; x < right; ++x) {
            LayerPixel& to = layer.pixels[static_cast<std::size_t>(y - top) * static_cast<std::size_t>(layer.width) +
                                          static_cast<std::size_t>(x - left)];
            const std::size_t index = impl_->background.index(x, y);
            if (active[index] == Reach::Near) {
                // A few samples of a soft shadow may all miss it: it takes all of them.
                const Seen& seen = impl_->seen[index];
                const bool smooth = reachOf(impl_->setting, bounds, seen.point, seen.normal) != Reach::Near;
                to = impl_->pixel(scene, things.size(), x, y, smooth ? firstOf(most) : most, most);
                continue;
            }
            to.around = impl_->background.pixels[index];
            if (active[index] == Reach::Far) {
                to.around *= shader.farShare(impl_->seen[index].point, impl_->seen[index].normal, things.size());
            }
        }
    });
    return layer;
}

Picture Tracer::picture(std::span<const Thing> things, int samples) const {
    Picture picture = impl_->background;
    const Layer moment = layer(things, samples);
    for (int y = moment.top; y < moment.top + moment.height; ++y) {
        for (int x = moment.left; x < moment.left + moment.width; ++x) {
            const LayerPixel& pixel = moment.at(x, y);
            picture.at(x, y) = pixel.around + pixel.things;
        }
    }
    return picture;
}

} // namespace elastoon
