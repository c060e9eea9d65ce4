// See ray_scene.h.
#include "ray_scene.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace elastoon {

namespace {

/// Embree's objects are counted references.
struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, Release>;
using EmbreeScene = std::unique_ptr<RTCSceneTy, Release>;

struct StoredMesh {
    DrawnMesh drawn;
    EmbreeScene scene;
    float mean_radius = 0.0F;
};

glm::vec3 asVec(const std::array<float, 3>& v) {
    return {v[0], v[1], v[2]};
}

template <class T>
void copyToBuffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, const std::vector<T>& values) {
    void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), values.size());
    std::copy(values.begin(), values.end(), static_cast<T*>(buffer));
}

EmbreeScene robustScene(RTCDevice device) {
    EmbreeScene scene(rtcNewScene(device));
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    return scene;
}

RTCRay embreeRay(const Ray& ray, float limit) {
    RTCRay out{};
    out.org_x = ray.origin.x;
    out.org_y = ray.origin.y;
    out.org_z = ray.origin.z;
    out.dir_x = ray.direction.x;
    out.dir_y = ray.direction.y;
    out.dir_z = ray.direction.z;
    out.tfar = limit;
    out.mask = ~0U;
    return out;
}

float meanRadiusOf(const DrawnMesh& mesh) {
    double volume = 0.0;
    for (const auto& corners : mesh.triangles) {
        const Vec3 a = asVec(mesh.positions[corners[0]]), b = asVec(mesh.positions[corners[1]]);
        volume += glm::dot(a, glm::cross(b, Vec3(asVec(mesh.positions[corners[2]])))) / 6.0;
    }
    return static_cast<float>(std::cbrt(volume * 0.75 / std::numbers::pi));
}

/// A mesh under its pose.
struct Instance {
    const StoredMesh* mesh = nullptr;
    glm::mat3 linear{1.0F}, for_normals{1.0F};
    glm::vec3 offset{0.0F};
    std::array<Color, kTintCount> colors{};
};

/// Greatest distance of the mapped mesh from its origin.
float reachOf(const StoredMesh& mesh, const glm::mat3& linear) {
    float most = 0.0F;
    for (const auto& position : mesh.drawn.positions) {
        const glm::vec3 mapped = linear * asVec(position);
        most = std::max(most, glm::dot(mapped, mapped));
    }
    return std::sqrt(most) * 1.0001F;
}

} // namespace

struct MeshStore::Impl {
    Device device;
    std::vector<std::unique_ptr<StoredMesh>> meshes;
};

std::array<Color, kTintCount> thingColors(const Vec3& body_color) {
    std::array<Color, kTintCount> colors{};
    for (std::size_t i = 0; i < kTintCount; ++i) {
        colors[i] = linearFromSrgb(tintColor(static_cast<Tint>(i), body_color));
    }
    return colors;
}

Result<MeshStore> MeshStore::create() {
    // One instruction set for all machines, one thread to build with: the same tree, the same bits. (Only Intel's
    // processors have a choice; elsewhere the device knows one set and refuses the word.)
#if defined(__x86_64__)
    constexpr const char* kConfig = "isa=sse2,threads=1";
#else
    constexpr const char* kConfig = "threads=1";
#endif
    auto impl = std::make_unique<Impl>();
    impl->device.reset(rtcNewDevice(kConfig));
    if (!impl->device) {
        return Error{fmt::format("Embree does not start (error {})", static_cast<int>(rtcGetDeviceError(nullptr))), {}};
    }
    return MeshStore(std::move(impl));
}

MeshStore::MeshStore(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
MeshStore::MeshStore(MeshStore&&) noexcept = default;
MeshStore& MeshStore::operator=(MeshStore&&) noexcept = default;
MeshStore::~MeshStore() = default;

std::size_t MeshStore::add(DrawnMesh mesh) {
    auto stored = std::make_unique<StoredMesh>();
    stored->drawn = std::move(mesh);
    stored->mean_radius = meanRadiusOf(stored->drawn);
    RTCDevice device = impl_->device.get();
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    copyToBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, stored->drawn.positions);
    copyToBuffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, stored->drawn.triangles);
    rtcCommitGeometry(geometry);
    stored->scene = robustScene(device);
    rtcAttachGeometry(stored->scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(stored->scene.get());
    impl_->meshes.push_back(std::move(stored));
    return impl_->meshes.size() - 1;
}

struct RayScene::Impl {
    EmbreeScene scene;
    std::vector<Instance> instances;
    std::vector<Bound> bounds;
};

RayScene::RayScene(const MeshStore& store, const Setting& setting, std::span<const Thing> things)
    : impl_(std::make_unique<Impl>()) {
    RTCDevice device = store.impl_->device.get();
    impl_->scene = robustScene(device);
    for (const Thing& thing : things) {
        Instance instance;
        instance.mesh = store.impl_->meshes[thing.mesh].get();
        const Mat3 linear = linearOf(thing.pose);
        instance.linear = glm::mat3(linear);
        instance.for_normals = glm::mat3(glm::transpose(glm::inverse(linear)));
        instance.offset = setting.local(thing.pose.position);
        instance.colors = thing.colors;
        impl_->bounds.push_back(
            {instance.offset, reachOf(*instance.mesh, instance.linear), instance.mesh->mean_radius});
        impl_->instances.push_back(instance);

        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(geometry, instance.mesh->scene.get());
        const std::array<glm::vec3, 4> columns{instance.linear[0], instance.linear[1], instance.linear[2],
                                               instance.offset};
        rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(impl_->scene.get(), geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(impl_->scene.get());
}

RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;
RayScene::~RayScene() = default;

const std::vector<Bound>& RayScene::bounds() const {
    return impl_->bounds;
}

bool RayScene::nearest(const Ray& ray, float limit, ThingHit& hit) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{};
    query.ray = embreeRay(ray, limit);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(impl_->scene.get(), &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return false;
    }
    hit.thing = query.hit.instID[0];
    hit.distance = query.ray.tfar;
    const Instance& instance = impl_->instances[hit.thing];
    const DrawnMesh& mesh = instance.mesh->drawn;
    const auto& corners = mesh.triangles[query.hit.primID];
    hit.color = instance.colors[static_cast<std::size_t>(mesh.tints[query.hit.primID])];
    const std::array<float, 3> weights{1.0F - query.hit.u - query.hit.v, query.hit.u, query.hit.v};
    hit.point = ray.origin + ray.direction * hit.distance;
    hit.smooth_point = glm::vec3(0.0F);
    glm::vec3 normal(0.0F);
    for (std::size_t i = 0; i < 3; ++i) {
        // Hanika, "Hacking the shadow terminator", Ray Tracing Gems II: onto the corner's tangent plane, then between
        // them.
        const glm::vec3 corner = instance.linear * asVec(mesh.positions[corners[i]]) + instance.offset;
        const glm::vec3 corner_normal = glm::normalize(instance.for_normals * asVec(mesh.normals[corners[i]]));
        const float below = std::min(0.0F, glm::dot(hit.point - corner, corner_normal));
        hit.smooth_point += weights[i] * (hit.point - corner_normal * below);
        normal += weights[i] * corner_normal;
    }
    hit.normal = glm::normalize(normal);
    return true;
}

bool RayScene::blocked(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay query = embreeRay(ray, std::numeric_limits<float>::infinity());
    rtcOccluded1(impl_->scene.get(), &context, &query);
    return query.tfar < 0.0F;
}

} // namespace elastoon
