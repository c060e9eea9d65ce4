// Solid things to shoot rays at: drawn meshes under affine poses, by Embree.
#pragma once

#include "drawn_mesh.h"
#include "setting.h"

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace elastoon {

/// A mesh somewhere: what is drawn for a body or an obstacle at one moment.
struct Thing {
    std::size_t mesh = 0; ///< as MeshStore::add() gave it
    Pose pose;
    std::array<Color, kTintCount> colors{}; ///< linear
};

/// The three linear colours of a thing of this sRGB colour.
[[nodiscard]] std::array<Color, kTintCount> thingColors(const Vec3& body_color);

/// The meshes of a show. Rays meet them the same way on every machine: one instruction set, robust traversal.
class MeshStore {
public:
    static Result<MeshStore> create();
    MeshStore(MeshStore&&) noexcept;
    MeshStore& operator=(MeshStore&&) noexcept;
    ~MeshStore();

    std::size_t add(DrawnMesh mesh);

private:
    friend class RayScene;
    struct Impl;
    explicit MeshStore(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

/// Where a ray meets a thing.
struct ThingHit {
    std::size_t thing = 0;
    glm::vec3 point{0.0F};
    glm::vec3 smooth_point{0.0F}; ///< lifted off the facet onto the round surface: rays that leave begin here
    glm::vec3 normal{0.0F};       ///< smooth, unit, outward
    Color color{0.0F};
    float distance = 0.0F;
};

/// A ball that holds a thing, and the ball of the same volume: what the thing looks like from afar.
struct Bound {
    glm::vec3 centre{0.0F};
    float radius = 0.0F;
    float mean_radius = 0.0F;
};

/// The things of one moment. Safe to ask from many threads.
class RayScene {
public:
    RayScene(const MeshStore& store, const Setting& setting, std::span<const Thing> things);
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;
    ~RayScene();

    [[nodiscard]] const std::vector<Bound>& bounds() const;
    /// The first thing along the ray nearer than `limit`; false if there is none.
    bool nearest(const Ray& ray, float limit, ThingHit& hit) const;
    [[nodiscard]] bool blocked(const Ray& ray) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace elastoon
