// See setting.h.
#include "setting.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace elastoon {

namespace {

// The sky is linear in the direction's height, so that its irradiance is known in closed form.
const Color kSkyMean(0.315F, 0.325F, 0.345F);
const Color kSkyRise(0.135F, 0.155F, 0.185F);
const Color kKey(0.86F, 0.82F, 0.75F);

const Color kPool(0.86F, 0.85F, 0.83F); // the ground where the light falls
const Color kHorizon(0.60F, 0.655F, 0.71F); // where ground and backdrop meet
const Color kHigh(0.36F, 0.46F, 0.57F);

constexpr float kWallReach = 2.6F; // half the width of a wall, in radii of the action

float smoothStep(float low, float high, float value) {
    const float t = std::clamp((value - low) / (high - low), 0.0F, 1.0F);
    return t * t * (3.0F - 2.0F * t);
}

float distanceToPlane(const DrawnPlane& plane, const Ray& ray) {
    const float approach = -glm::dot(ray.direction, plane.normal);
    const float height = glm::dot(ray.origin - plane.point, plane.normal);
    if (approach <= 1e-6F || height <= 0.0F) {
        return std::numeric_limits<float>::infinity();
    }
    return height / approach;
}

bool inSolid(const Setting& setting, std::size_t wall, const glm::vec3& point) {
    const float slack = 1e-4F * setting.radius;
    for (std::size_t i = 0; i < setting.walls.size(); ++i) {
        const DrawnPlane& other = setting.walls[i];
        if (i != wall && glm::dot(point - other.point, other.normal) < -slack) {
            return true;
        }
    }
    return false;
}

} // namespace

SettingHit meetSetting(const Setting& setting, const Ray& ray) {
    SettingHit hit;
    hit.distance = std::numeric_limits<float>::infinity();
    if (setting.ground) {
        const float distance = distanceToPlane(*setting.ground, ray);
        if (distance < hit.distance) {
            hit = {SettingHit::Kind::Ground, 0, distance};
        }
    }
    for (std::size_t i = 0; i < setting.walls.size(); ++i) {
        const float distance = distanceToPlane(setting.walls[i], ray);
        if (distance < hit.distance) {
            const glm::vec3 point = ray.origin + ray.direction * distance;
            if (!inSolid(setting, i, point) && wallPresence(setting, setting.walls[i], point) > 0.0F) {
                hit = {SettingHit::Kind::Wall, i, distance};
            }
        }
    }
    return hit;
}

Color backdropColor(const Setting& setting, const Ray& ray) {
    const float rise = glm::dot(ray.direction, setting.up);
    if (setting.ground) {
        const float distance = distanceToPlane(*setting.ground, ray);
        if (std::isfinite(distance)) {
            // The pool of light ends so gently that the horizon does not show: its share goes with 1/distance^2.
            const glm::vec3 point = ray.origin + ray.direction * distance;
            const glm::vec3 centre = -setting.up * glm::dot(-setting.ground->point, setting.up);
            const glm::vec3 aside = (point - centre) / (2.1F * setting.radius);
            const float pool = 1.0F / (1.0F + glm::dot(aside, aside));
            return glm::mix(kHorizon, kPool * setting.ground->color, pool);
        }
    }
    const float height = std::fabs(rise);
    return glm::mix(kHorizon, kHigh, smoothStep(0.0F, 0.75F, height));
}

Color wallColor(const Setting& setting, const DrawnPlane& wall) {
    // Less contrast than the light gives, so that a wall that faces away is no black hole in a bright picture.
    const Color lit = (keyIrradiance(setting, wall.normal) + skyIrradiance(setting, wall.normal)) /
                      (keyIrradiance(setting, setting.up) + skyIrradiance(setting, setting.up));
    return kPool * wall.color * (Color(0.42F) + 0.53F * lit);
}

float wallPresence(const Setting& setting, const DrawnPlane& wall, const glm::vec3& point) {
    const glm::vec3 centre = wall.normal * glm::dot(wall.point, wall.normal); // of the action, dropped onto the wall
    const float away = glm::length(point - centre) / setting.radius;
    return 1.0F - smoothStep(0.55F * kWallReach, kWallReach, away);
}

Color skyRadiance(const Setting& setting, const glm::vec3& direction) {
    return kSkyMean + kSkyRise * glm::dot(direction, setting.up);
}

Color skyIrradiance(const Setting& setting, const glm::vec3& normal) {
    return kSkyMean + kSkyRise * (2.0F / 3.0F * glm::dot(normal, setting.up));
}

Color keyIrradiance(const Setting& setting, const glm::vec3& normal) {
    // A broad light reaches a little beyond the edge of the lit half.
    constexpr float kWrap = 0.12F;
    const float facing = (glm::dot(normal, setting.to_light) + kWrap) / (1.0F + kWrap);
    return kKey * std::max(0.0F, facing);
}

} // namespace elastoon
