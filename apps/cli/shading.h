// Light that leaves a surface point towards the eye: key light with soft shadow, sky with occlusion, one bounce.
#pragma once

#include "bound_groups.h"
#include "ray_scene.h"
#include "setting.h"

#include <cstdint>
#include <span>

namespace elastoon {

/// Which sample of which pixel: seeds the directions that are tried.
struct SampleKey {
    std::uint32_t pixel = 0;
    std::uint32_t index = 0;
};

/// No thing: a point of the ground or of a wall.
inline constexpr std::size_t kNoThing = ~std::size_t{0};

/// How things can change the light on a point of the setting or of a solid.
enum class Reach : std::uint8_t {
    None, ///< not to be seen
    Far,  ///< a little less sky: closed form, smooth
    Near, ///< shadow and closeness: rays
};

[[nodiscard]] Reach reachOf(const Setting& setting, const BoundGroups& bounds, const glm::vec3& point,
                            const glm::vec3& normal);

/// Looks at one moment. Rays are shot only where a thing's bound can matter; everything else is closed form, without
/// noise.
class Shader {
public:
    /// The first `count` things are those that softShare() and first() tell of.
    Shader(const Setting& setting, const RayScene& things, std::size_t count)
        : setting_(setting), things_(things), all_(things.bounds()), first_(std::span(things.bounds()).first(count)) {}

    /// The bounds of the first things alone.
    [[nodiscard]] const BoundGroups& first() const { return first_; }

    /// Light of a point of a thing that is seen along the ray.
    [[nodiscard]] Color thingColor(const ThingHit& hit, const Ray& sight, SampleKey key) const;
    /// Share of the light that a point of the ground or a wall gets, of what it would get with nothing in the way.
    [[nodiscard]] Color litShare(const glm::vec3& point, const glm::vec3& normal, SampleKey key) const;
    /// The same for the first things alone, well sampled: 2 * samples rays to the light where its edge is near.
    [[nodiscard]] Color softShare(const glm::vec3& point, const glm::vec3& normal, std::uint32_t pixel,
                                  std::uint32_t samples) const;
    /// Colour of the setting along the ray, with shadows.
    [[nodiscard]] Color settingColor(const SettingHit& hit, const Ray& sight, SampleKey key) const;

private:
    [[nodiscard]] float keyVisible(const glm::vec3& point, const glm::vec3& normal, SampleKey key) const;
    [[nodiscard]] Color irradiance(const glm::vec3& point, const glm::vec3& normal, std::size_t self,
                                   SampleKey key) const;
    [[nodiscard]] Color nearChange(const glm::vec3& point, const glm::vec3& normal, bool things_near,
                                   SampleKey key) const;
    [[nodiscard]] Color farChange(const BoundGroups& bounds, const glm::vec3& point, const glm::vec3& normal,
                                  std::size_t self) const;
    [[nodiscard]] Color openIrradiance(const glm::vec3& normal) const;

    const Setting& setting_;
    const RayScene& things_;
    BoundGroups all_, first_;
};

} // namespace elastoon
