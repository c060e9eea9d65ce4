// Points to sample at, by pixel, use and index: the same on every machine. Integers and + - * / sqrt only.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstdint>

namespace elastoon::sampling {

[[nodiscard]] inline std::uint32_t hash(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x21f0aaadU;
    x ^= x >> 15;
    x *= 0xd35a2d97U;
    return x ^ (x >> 15);
}

[[nodiscard]] inline std::uint32_t hash(std::uint32_t a, std::uint32_t b) {
    return hash(a ^ (hash(b) + 0x9e3779b9U + (a << 6) + (a >> 2)));
}

[[nodiscard]] inline std::uint32_t reverseBits(std::uint32_t x) {
    x = ((x >> 1) & 0x55555555U) | ((x & 0x55555555U) << 1);
    x = ((x >> 2) & 0x33333333U) | ((x & 0x33333333U) << 2);
    x = ((x >> 4) & 0x0f0f0f0fU) | ((x & 0x0f0f0f0fU) << 4);
    x = ((x >> 8) & 0x00ff00ffU) | ((x & 0x00ff00ffU) << 8);
    return (x >> 16) | (x << 16);
}

/// Owen's scrambling of a reversed index, by Laine and Karras, constants by Burley (JCGT 2020).
[[nodiscard]] inline std::uint32_t scramble(std::uint32_t reversed, std::uint32_t seed) {
    reversed += seed;
    reversed ^= reversed * 0x6c50b47cU;
    reversed ^= reversed * 0xb82f1e52U;
    reversed ^= reversed * 0xc7afe638U;
    reversed ^= reversed * 0x8d22f6e6U;
    return reversed;
}

[[nodiscard]] inline float toUnit(std::uint32_t bits) {
    return static_cast<float>(bits >> 8) * 0x1p-24F;
}

/// Point `index` of the (0,2) sequence that belongs to `seed`, in [0,1)^2: any 2^k first points are stratified.
[[nodiscard]] inline glm::vec2 point(std::uint32_t seed, std::uint32_t index) {
    const std::uint32_t shuffled = reverseBits(scramble(reverseBits(index), hash(seed, 1)));
    std::uint32_t second = 0;
    std::uint32_t direction = 0x80000000U;
    for (std::uint32_t rest = shuffled; rest != 0; rest >>= 1, direction ^= direction >> 1) {
        second ^= (rest & 1U) != 0 ? direction : 0U;
    }
    const std::uint32_t x = reverseBits(scramble(shuffled, hash(seed, 2)));
    const std::uint32_t y = reverseBits(scramble(reverseBits(second), hash(seed, 3)));
    return {toUnit(x), toUnit(y)};
}

/// [0,1)^2 to the unit disk, areas kept (Shirley and Chiu).
[[nodiscard]] inline glm::vec2 diskPoint(const glm::vec2& unit) {
    const float a = 2.0F * unit.x - 1.0F;
    const float b = 2.0F * unit.y - 1.0F;
    const bool wide = std::fabs(a) > std::fabs(b);
    const float radius = wide ? a : b;
    if (radius == 0.0F) {
        return {0.0F, 0.0F};
    }
    const float angle = 0.78539816F * (wide ? b / a : a / b);
    const float q = angle * angle;
    const float sine = angle * (1.0F - q * (1.0F / 6.0F - q * (1.0F / 120.0F - q / 5040.0F)));
    const float cosine = 1.0F - q * (0.5F - q * (1.0F / 24.0F - q * (1.0F / 720.0F - q / 40320.0F)));
    return wide ? glm::vec2(radius * cosine, radius * sine) : glm::vec2(radius * sine, radius * cosine);
}

/// [0,1) to an offset in (-1,1) whose density is a tent: the filter of a pixel.
[[nodiscard]] inline float tent(float unit) {
    return unit < 0.5F ? std::sqrt(2.0F * unit) - 1.0F : 1.0F - std::sqrt(2.0F - 2.0F * unit);
}

/// Two unit vectors that make a right-handed frame with the unit vector n (Duff et al., JCGT 2017).
inline void frameAbout(const glm::vec3& n, glm::vec3& tangent, glm::vec3& bitangent) {
    const float sign = std::copysign(1.0F, n.z);
    const float a = -1.0F / (sign + n.z);
    const float b = n.x * n.y * a;
    tangent = {1.0F + sign * n.x * n.x * a, sign * b, -sign * n.x};
    bitangent = {b, sign + n.y * n.y * a, -n.y};
}

/// Direction about the unit vector n, density proportional to the cosine.
[[nodiscard]] inline glm::vec3 cosineDirection(const glm::vec3& n, const glm::vec2& unit) {
    const glm::vec2 disk = diskPoint(unit);
    glm::vec3 tangent, bitangent;
    frameAbout(n, tangent, bitangent);
    const float height = std::sqrt(std::fmax(0.0F, 1.0F - disk.x * disk.x - disk.y * disk.y));
    return tangent * disk.x + bitangent * disk.y + n * height;
}

} // namespace elastoon::sampling
