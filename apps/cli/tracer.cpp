// See tracer.h.
#include "tracer.h"

#include "moment.h"

#include <algorithm>
#include <cmath>

namespace elastoon {

namespace {

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

bool sameFlat(const Seen& a, const Seen& b, float reach) {
    if (a.solid || b.solid || a.normal != b.normal) {
        return false;
    }
    return std::fabs(glm::dot(a.point - b.point, a.normal)) < 1e-3F * reach;
}

Seen seenAt(const Backdrop& backdrop, const RayScene& scene, int x, int y) {
    const Setting& setting = backdrop.setting;
    const Ray ray = backdrop.eye.through(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
    const SettingHit behind = meetSetting(setting, ray);
    ThingHit hit;
    if (scene.nearest(ray, behind.distance, hit)) {
        return {hit.point, hit.normal, 1.0F, true, false};
    }
    if (behind.kind == SettingHit::Kind::Nothing) {
        return {};
    }
    const glm::vec3 point = ray.origin + ray.direction * behind.distance;
    if (behind.kind == SettingHit::Kind::Ground) {
        return {point, setting.ground->normal};
    }
    const DrawnPlane& wall = setting.walls[behind.wall];
    return {point, wall.normal, wallPresence(setting, wall, point)};
}

bool isPlain(const Backdrop& backdrop, const BoundGroups& solids, int x, int y) {
    const PictureSize size = backdrop.size;
    const std::vector<Seen>& seen = backdrop.seen;
    const Seen& middle = seen[backdrop.picture.index(x, y)];
    for (int v = std::max(0, y - 1); v <= std::min(size.height - 1, y + 1); ++v) {
        for (int u = std::max(0, x - 1); u <= std::min(size.width - 1, x + 1); ++u) {
            if (!sameFlat(middle, seen[backdrop.picture.index(u, v)], backdrop.setting.radius)) {
                return false;
            }
        }
    }
    return middle.normal == glm::vec3(0.0F) ||
           reachOf(backdrop.setting, solids, middle.point, middle.normal) != Reach::Near;
}

void drawBackdrop(Backdrop& backdrop) {
    const RayScene scene(*backdrop.meshes, backdrop.setting, backdrop.solids);
    backdrop.picture = makePicture(backdrop.size);
    backdrop.seen.assign(backdrop.size.pixelCount(), {});
    const auto forPixels = [&](const auto& pixel) {
        backdrop.forRows(0, backdrop.size.height, [&](int y) {
            for (int x = 0; x < backdrop.size.width; ++x) {
                pixel(x, y, backdrop.picture.index(x, y));
            }
        });
    };
    forPixels([&](int x, int y, std::size_t index) { backdrop.seen[index] = seenAt(backdrop, scene, x, y); });
    const BoundGroups solids(scene.bounds());
    std::vector<std::uint8_t> plain(backdrop.size.pixelCount());
    forPixels([&](int x, int y, std::size_t index) { plain[index] = isPlain(backdrop, solids, x, y) ? 1 : 0; });
    for (Seen& seen : backdrop.seen) {
        seen.plain = false; // there is no picture yet that a shadow could be a factor on
    }
    const Moment empty(backdrop, {}, {});
    forPixels([&](int x, int y, std::size_t index) {
        backdrop.picture.pixels[index] =
            plain[index] != 0 ? empty.settingAt(x, y) : empty.pixel(Work::Full, x, y).around;
    });
    for (std::size_t i = 0; i < plain.size(); ++i) {
        backdrop.seen[i].plain = plain[i] != 0;
    }
}

} // namespace

struct Tracer::Impl : Backdrop {};

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
    drawBackdrop(*impl_);
}

const Picture& Tracer::background() const {
    return impl_->picture;
}

Layer Tracer::layer(std::span<const Thing> things, const LayerOptions& options) const {
    const Moment moment(*impl_, things, options);
    const std::vector<Work> plan = moment.plan();
    const PictureSize size = impl_->size;
    int left = size.width, right = 0, top = size.height, bottom = 0;
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            if (plan[impl_->picture.index(x, y)] != Work::None) {
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
    impl_->forRows(top, bottom, [&](int y) {
        for (int x = left; x < right; ++x) {
            layer.pixels[static_cast<std::size_t>(y - top) * static_cast<std::size_t>(layer.width) +
                         static_cast<std::size_t>(x - left)] = moment.pixel(plan[impl_->picture.index(x, y)], x, y);
        }
    });
    return layer;
}

Picture Tracer::picture(std::span<const Thing> things, const LayerOptions& options) const {
    Picture picture = impl_->picture;
    const Layer moment = layer(things, options);
    for (int y = moment.top; y < moment.top + moment.height; ++y) {
        for (int x = moment.left; x < moment.left + moment.width; ++x) {
            const LayerPixel& pixel = moment.at(x, y);
            picture.at(x, y) = pixel.around + pixel.things;
        }
    }
    return picture;
}

} // namespace elastoon
