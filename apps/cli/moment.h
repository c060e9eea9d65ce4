// The things of one moment before what stands still: which pixels they touch, and what they do there.
#pragma once

#include "picture.h"
#include "sampling.h"
#include "shading.h"
#include "tracer.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <thread>
#include <vector>

namespace elastoon {

/// The camera in single precision about the setting's origin.
struct Eye {
    glm::vec3 origin{0.0F}, right{1.0F, 0.0F, 0.0F}, up{0.0F, 1.0F, 0.0F}, forward{0.0F, 0.0F, -1.0F};
    float step = 1.0F; // of a pixel at distance 1
    float centre_x = 0.0F, centre_y = 0.0F;

    [[nodiscard]] Ray through(float x, float y) const {
        return {origin, glm::normalize(forward + right * ((x - centre_x) * step) + up * ((centre_y - y) * step))};
    }
};

/// What the middle of a pixel shows of the background: tells where things can matter.
struct Seen {
    glm::vec3 point{0.0F};
    glm::vec3 normal{0.0F}; ///< zero: the backdrop
    float presence = 1.0F;  ///< of a wall
    bool solid = false;
    /// The pixel shows one flat surface that no solid is near to: shadows there are a factor on the background.
    bool plain = true;
};

/// What a pixel costs.
enum class Work : std::uint8_t {
    None, ///< the background
    Far,  ///< a closed form
    Soft, ///< light rays from one point
    Full, ///< lines of sight
};

/// What stands still, and the picture of it.
struct Backdrop {
    PictureSize size;
    TraceOptions options;
    std::optional<MeshStore> meshes;
    Setting setting;
    Eye eye;
    std::vector<Thing> solids;
    Picture picture;
    std::vector<Seen> seen; ///< for each pixel

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
};

/// The things of one moment before the background of a tracer.
/// The backdrop must outlive it. Safe to ask from many threads.
class Moment {
public:
    Moment(const Backdrop& backdrop, std::span<const Thing> things, const LayerOptions& options);

    [[nodiscard]] std::vector<Work> plan() const;
    [[nodiscard]] LayerPixel pixel(Work work, int x, int y) const;
    /// What the middle of a pixel shows of the setting, solids left out.
    [[nodiscard]] Color settingAt(int x, int y) const;

private:
    [[nodiscard]] Work workAt(int x, int y) const;
    [[nodiscard]] bool coverable(const Ray& ray) const;
    [[nodiscard]] Color shareAt(const Seen& seen, std::uint32_t seed) const;
    [[nodiscard]] LayerPixel sample(const Ray& ray, bool plain, SampleKey key) const;
    [[nodiscard]] LayerPixel sampled(int x, int y, bool plain, std::uint32_t seed) const;

    const Backdrop& backdrop_;
    std::vector<Thing> all_; // things come before the solids
    RayScene scene_;
    Shader shader_;
    std::size_t count_;
    std::span<const Bound> bounds_;
    int samples_;
    bool shadows_;
    std::uint32_t seed_;
};

} // namespace elastoon
