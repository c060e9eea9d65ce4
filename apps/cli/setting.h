// What stands around the bodies: the ground that fades into the backdrop, walls, and the light. All of it is analytic.
#pragma once

#include "picture.h"

#include <glm/vec3.hpp>

#include <optional>
#include <vector>

namespace elastoon {

/// A plane as it is drawn, relative to the setting's origin; seen from the side of its normal only.
struct DrawnPlane {
    glm::vec3 point{0.0F};
    glm::vec3 normal{0.0F, 1.0F, 0.0F};
    Color color{1.0F}; ///< tint of the setting's own; 1 leaves it
};

/// Lengths are relative to `origin`, so that single precision is enough far from the world's.
struct Setting {
    Vec3 origin{0.0};                             ///< centre of the action, world
    float radius = 1.0F;                          ///< of the action, m
    glm::vec3 up{0.0F, 1.0F, 0.0F};
    glm::vec3 to_light{-0.35F, 0.85F, 0.38F};     ///< unit
    std::optional<DrawnPlane> ground;             ///< its normal is up
    std::vector<DrawnPlane> walls;

    [[nodiscard]] glm::vec3 local(const Vec3& world) const { return glm::vec3(world - origin); }
};

/// Half the light's width over its distance: how soft shadows are.
inline constexpr float kLightSpread = 0.085F;

/// A line of sight; the direction is unit.
struct Ray {
    glm::vec3 origin{0.0F};
    glm::vec3 direction{0.0F, 0.0F, -1.0F};
};

/// Where a ray meets the setting.
struct SettingHit {
    enum class Kind : std::uint8_t { Nothing, Ground, Wall };
    Kind kind = Kind::Nothing;
    std::size_t wall = 0;
    float distance = 0.0F;
};

[[nodiscard]] SettingHit meetSetting(const Setting& setting, const Ray& ray);

/// Colour of the ground or the backdrop that is seen along the ray, where nothing casts shadow.
[[nodiscard]] Color backdropColor(const Setting& setting, const Ray& ray);

/// Colour of a wall where nothing casts shadow.
[[nodiscard]] Color wallColor(const Setting& setting, const DrawnPlane& wall);

/// How much of a wall is seen at a point of it: walls fade out far from the action. 0..1.
[[nodiscard]] float wallPresence(const Setting& setting, const DrawnPlane& wall, const glm::vec3& point);

/// Light from the sky and the ground's reflection along a direction away from the surface.
[[nodiscard]] Color skyRadiance(const Setting& setting, const glm::vec3& direction);
/// The same gathered over the half sphere about a normal, over pi.
[[nodiscard]] Color skyIrradiance(const Setting& setting, const glm::vec3& normal);
/// Light of the key light on a surface that it reaches, over pi.
[[nodiscard]] Color keyIrradiance(const Setting& setting, const glm::vec3& normal);

} // namespace elastoon
