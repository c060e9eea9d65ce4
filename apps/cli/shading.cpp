// See shading.h.
#include "shading.h"

#include "sampling.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace elastoon {

namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr float kLeastHidden = 0.004F; // a share of the sky that is not worth darkening for
// Beyond the second distance, in radii of its bound, a thing counts as a ball of its volume, within the first it is met
// with rays; between the two, both count in part.
constexpr float kNear = 1.5F, kFarAway = 2.3F;
constexpr float kLift = 2e-5F; // of the start of a ray off its surface, in radii of the action

constexpr std::uint32_t kNearRays = 3; // for a line of sight: another thing close by is what varies most

// What the directions of a sample are for: each gets its own sequence.
enum Use : std::uint32_t { KeyUse = 11, SkyUse = 12, BounceUse = 13 };

glm::vec2 unitPoint(SampleKey key, std::uint32_t use) {
    return sampling::point(sampling::hash(key.pixel, use), key.index);
}

float fifthPower(float x) {
    const float square = x * x;
    return square * square * x;
}

/// x^32 without the math library.
float highPower(float x) {
    for (int i = 0; i < 5; ++i) {
        x *= x;
    }
    return x;
}

/// Whether a ball can hide the key light from the point, or a part of it.
bool mayShade(const Setting& setting, const Bound& bound, const glm::vec3& point) {
    const glm::vec3 to = bound.centre - point;
    const float along = glm::dot(to, setting.to_light);
    if (along < -bound.radius) {
        return false;
    }
    const glm::vec3 aside = to - setting.to_light * along;
    const float reach = bound.radius * 1.01F + std::max(along, 0.0F) * (kLightSpread * 1.01F);
    return glm::dot(aside, aside) < reach * reach;
}

/// Whether the key light can be hidden from the point by any but `self`.
bool mayShade(const Setting& setting, const BoundGroups& bounds, const glm::vec3& point, std::size_t self) {
    return bounds.any([&](const BoundGroup& group) { return mayShade(setting, group.ball, point); },
                      [&](std::size_t i) { return i != self && mayShade(setting, bounds.bounds()[i], point); });
}

/// Share of the sky over the point that a ball hides.
float hiddenBy(const Bound& bound, const glm::vec3& point, const glm::vec3& normal) {
    const float radius = bound.mean_radius;
    const glm::vec3 to = bound.centre - point;
    const float square = glm::dot(to, to);
    if (square <= radius * radius) {
        return 1.0F;
    }
    const float facing = std::clamp((glm::dot(to, normal) + 0.5F * radius) / std::sqrt(square), 0.0F, 1.0F);
    return radius * radius / square * facing;
}

/// 0: the thing counts as a far ball; 1: with its shape.
float nearness(const Bound& bound, const glm::vec3& point) {
    const float distance = glm::length(bound.centre - point) / bound.radius;
    return std::clamp((kFarAway - distance) / (kFarAway - kNear), 0.0F, 1.0F);
}

bool anyNear(const BoundGroups& bounds, const glm::vec3& point, std::size_t self) {
    const auto may_be = [&](const BoundGroup& group) {
        const float reach = group.ball.radius + kFarAway * group.largest;
        const glm::vec3 to = group.ball.centre - point;
        return glm::dot(to, to) < reach * reach;
    };
    return bounds.any(may_be, [&](std::size_t i) { return i != self && nearness(bounds.bounds()[i], point) > 0.0F; });
}

float greatestHidden(const BoundGroups& bounds, const glm::vec3& point, const glm::vec3& normal) {
    float most = 0.0F;
    for (const BoundGroup& group : bounds.groups()) {
        const float nearest = glm::length(group.ball.centre - point) - group.ball.radius;
        const float worth = std::max(most, 0.25F * kLeastHidden);
        if (nearest > 0.0F && group.largest_mean * group.largest_mean < worth * nearest * nearest) {
            continue;
        }
        for (const std::uint32_t index : group.members) {
            most = std::max(most, hiddenBy(bounds.bounds()[index], point, normal));
        }
    }
    return most;
}

} // namespace

Reach reachOf(const Setting& setting, const BoundGroups& bounds, const glm::vec3& point, const glm::vec3& normal) {
    if (anyNear(bounds, point, kNoThing) || mayShade(setting, bounds, point, kNoThing)) {
        return Reach::Near;
    }
    return greatestHidden(bounds, point, normal) > kLeastHidden ? Reach::Far : Reach::None;
}

/// 1 or 0: whether one direction of the key light is free.
float Shader::keyVisible(const glm::vec3& point, const glm::vec3& normal, SampleKey key) const {
    glm::vec3 tangent, bitangent;
    sampling::frameAbout(setting_.to_light, tangent, bitangent);
    const glm::vec2 disk = sampling::diskPoint(unitPoint(key, KeyUse)) * kLightSpread;
    const glm::vec3 direction = glm::normalize(setting_.to_light + tangent * disk.x + bitangent * disk.y);
    if (glm::dot(direction, normal) <= 0.0F) {
        return 1.0F; // in the surface's own shade, which keyIrradiance() knows of: a ray would count it twice
    }
    return things_.blocked({point + normal * (kLift * setting_.radius), direction}) ? 0.0F : 1.0F;
}

Color Shader::openIrradiance(const glm::vec3& normal) const {
    return keyIrradiance(setting_, normal) + skyIrradiance(setting_, normal);
}

/// What one direction of the sky tells: the light that comes instead of the sky's. Its mean is the change of the sky's
/// light.
Color Shader::nearChange(const glm::vec3& point, const glm::vec3& normal, bool things_near, SampleKey key) const {
    const Ray ray{point + normal * (kLift * setting_.radius),
                  sampling::cosineDirection(normal, unitPoint(key, SkyUse))};
    const Color open = skyRadiance(setting_, ray.direction);
    ThingHit hit;
    if (things_near && things_.nearest(ray, kFar, hit)) {
        const Color bounced = hit.color * openIrradiance(hit.normal) * 0.8F;
        return (bounced - open) * nearness(things_.bounds()[hit.thing], point);
    }
    if (!setting_.ground || glm::dot(ray.direction, setting_.up) >= 0.0F) {
        return Color(0.0F);
    }
    const SettingHit ground = meetSetting(setting_, ray);
    if (ground.kind != SettingHit::Kind::Ground) {
        return Color(0.0F);
    }
    const glm::vec3 foot = ray.origin + ray.direction * ground.distance;
    const glm::vec3& up = setting_.up;
    Color light = skyIrradiance(setting_, up) * (1.0F - greatestHidden(all_, foot, up));
    if (!mayShade(setting_, all_, foot, kNoThing)) {
        light += keyIrradiance(setting_, up);
    } else {
        light += keyIrradiance(setting_, up) * keyVisible(foot, up, {key.pixel ^ BounceUse, key.index});
    }
    return open * (light / openIrradiance(up) - 1.0F);
}

Color Shader::farChange(const BoundGroups& bounds, const glm::vec3& point, const glm::vec3& normal,
                        std::size_t self) const {
    constexpr float kWayOff = 3.0F; // radii of a group, from where it is one ball: the difference is not to be seen
    float hidden = 0.0F;
    for (const BoundGroup& group : bounds.groups()) {
        const glm::vec3 to = group.ball.centre - point;
        const float off = kWayOff * group.ball.radius;
        if (group.members.size() > 1 && glm::dot(to, to) > off * off) {
            hidden += hiddenBy(group.ball, point, normal);
            continue;
        }
        for (const std::uint32_t index : group.members) {
            if (index != self) {
                const Bound& bound = bounds.bounds()[index];
                hidden += hiddenBy(bound, point, normal) * (1.0F - nearness(bound, point));
            }
        }
    }
    return skyIrradiance(setting_, normal) * (-0.8F * std::min(hidden, 0.8F));
}

Color Shader::irradiance(const glm::vec3& point, const glm::vec3& normal, std::size_t self, SampleKey key) const {
    const BoundGroups& bounds = all_;
    Color light = skyIrradiance(setting_, normal) + farChange(bounds, point, normal, self);
    const Color direct = keyIrradiance(setting_, normal);
    if (direct.g > 0.0F) {
        light += mayShade(setting_, bounds, point, self) ? direct * keyVisible(point, normal, key) : direct;
    }
    const bool things_near = anyNear(bounds, point, self);
    if (things_near || self != kNoThing) {
        const std::uint32_t rays = things_near ? kNearRays : 1;
        Color change(0.0F);
        for (std::uint32_t i = 0; i < rays; ++i) {
            change += nearChange(point, normal, things_near, {key.pixel, key.index * rays + i});
        }
        light += change / static_cast<float>(rays);
    }
    return glm::max(light, Color(0.0F));
}

Color Shader::softShare(const glm::vec3& point, const glm::vec3& normal, std::uint32_t pixel,
                        std::uint32_t samples) const {
    const BoundGroups& bounds = first_;
    Color light = skyIrradiance(setting_, normal) + farChange(bounds, point, normal, kNoThing);
    Color direct = keyIrradiance(setting_, normal);
    if (direct.g > 0.0F && mayShade(setting_, bounds, point, kNoThing)) {
        float free = 0.0F;
        std::uint32_t rays = 0;
        const auto shoot = [&](std::uint32_t end) {
            for (; rays < end; ++rays) {
                free += keyVisible(point, normal, {pixel, rays});
            }
        };
        shoot(std::max(6U, samples / 2));
        if (free > 0.0F && free < static_cast<float>(rays)) { // else all in light or all in shadow
            shoot(std::max(rays, 2 * samples));
        }
        direct *= free / static_cast<float>(rays);
    }
    if (anyNear(bounds, point, kNoThing)) {
        Color change(0.0F);
        for (std::uint32_t i = 0; i < samples; ++i) {
            change += nearChange(point, normal, true, {pixel, i});
        }
        light += change / static_cast<float>(samples);
    }
    return glm::max(light + direct, Color(0.0F)) / openIrradiance(normal);
}

Color Shader::litShare(const glm::vec3& point, const glm::vec3& normal, SampleKey key) const {
    return irradiance(point, normal, kNoThing, key) / openIrradiance(normal);
}

Color Shader::settingColor(const SettingHit& hit, const Ray& sight, SampleKey key) const {
    const Color backdrop = backdropColor(setting_, sight);
    if (hit.kind == SettingHit::Kind::Nothing) {
        return backdrop;
    }
    const glm::vec3 point = sight.origin + sight.direction * hit.distance;
    if (hit.kind == SettingHit::Kind::Ground) {
        return backdrop * litShare(point, setting_.ground->normal, key);
    }
    const DrawnPlane& wall = setting_.walls[hit.wall];
    const Color share = litShare(point, wall.normal, key);
    const Color base = wallColor(setting_, wall);
    const float presence = wallPresence(setting_, wall, point);
    return glm::mix(backdrop, base, presence) * glm::mix(Color(1.0F), share, presence);
}

Color Shader::thingColor(const ThingHit& hit, const Ray& sight, SampleKey key) const {
    const Color diffuse = hit.color * irradiance(hit.smooth_point, hit.normal, hit.thing, key);
    const float facing = std::max(0.0F, -glm::dot(hit.normal, sight.direction));
    const glm::vec3 mirrored = sight.direction + hit.normal * (2.0F * facing);
    const Color sheen = skyRadiance(setting_, mirrored) * (0.03F + 0.42F * fifthPower(1.0F - facing));
    const glm::vec3 half = glm::normalize(setting_.to_light - sight.direction);
    const Color gloss(0.16F * highPower(std::max(0.0F, glm::dot(half, hit.normal))));
    return diffuse + sheen + gloss;
}

} // namespace elastoon
