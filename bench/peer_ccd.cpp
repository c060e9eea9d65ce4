// libccd, double. It exports no distance; this is the distance loop over libccd's parts that FCL carries, called
// without the rest of FCL. Support functions are the caller's affair: here they climb, and start where they last ended.
#include "contender.h"
#include "topology.h"

#include <fcl/narrowphase/detail/convexity_based_algorithm/gjk_libccd.h>

#include <limits>

namespace elastoon {

namespace {

constexpr unsigned kIterations = 500; // FCL's own
constexpr double kTolerance = 1e-6; // FCL's own

struct CcdBody {
    const Shape* shape = nullptr;
    std::vector<Vec3> baked; ///< stretched, not turned; empty where the support function stretches
    Mat3 rotation{1.0};
    Vec3 scale{1.0};
    Vec3 position{0.0};
    std::uint32_t last = 0;

    void pose(const Pose& pose) {
        rotation = glm::mat3_cast(pose.orientation);
        position = pose.position;
    }
};

void put(const CcdBody& body, const Vec3& local, ccd_vec3_t* found) {
    const Vec3 world = body.position + body.rotation * local;
    ccdVec3Set(found, world.x, world.y, world.z);
}

Vec3 localDirection(const CcdBody& body, const ccd_vec3_t* direction) {
    return glm::transpose(body.rotation) * Vec3(direction->v[0], direction->v[1], direction->v[2]);
}

void supportBaked(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* found) {
    auto& body = *static_cast<CcdBody*>(const_cast<void*>(object));
    body.last = climb(body.baked, body.shape->topology(), localDirection(body, direction), body.last);
    put(body, body.baked[body.last], found);
}

void supportMapped(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* found) {
    auto& body = *static_cast<CcdBody*>(const_cast<void*>(object));
    const auto vertices = body.shape->vertices();
    body.last = climb(vertices, body.shape->topology(), body.scale * localDirection(body, direction), body.last);
    put(body, body.scale * vertices[body.last], found);
}

void supportBox(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* found) {
    const auto& body = *static_cast<const CcdBody*>(object);
    const Vec3 half = body.shape->extents() * 0.5;
    const Vec3 local = localDirection(body, direction);
    put(body, {std::copysign(half.x, local.x), std::copysign(half.y, local.y), std::copysign(half.z, local.z)}, found);
}

class Ccd : public DistanceLoop<Ccd> {
public:
    Ccd(const DistanceScene& scene, std::string name, bool baked)
        : DistanceLoop(std::move(name), baked), coherent_(scene.coherent) {
        body_.shape = scene.body.shape.get();
        other_.shape = scene.other.get();
        other_.pose(scene.other_pose);
        if (baked) {
            body_.baked.resize(body_.shape->vertices().size());
        }
        support_body_ = baked ? supportBaked : supportMapped;
        support_other_ = other_.shape->kind() == ShapeKind::Box ? supportBox : supportMapped;
    }
    void bake(const Pose& pose) {
        body_.scale = scaleOf(pose.stretch);
        const auto vertices = body_.shape->vertices();
        for (std::size_t i = 0; i < body_.baked.size(); ++i) {
            body_.baked[i] = body_.scale * vertices[i];
        }
    }
    double ask(const Pose& pose) {
        body_.pose(pose);
        if (!coherent_) {
            body_.last = other_.last = 0;
        }
        double distance = 0.0;
        fcl::Vector3d a;
        fcl::Vector3d b;
        const bool apart = fcl::detail::GJKDistance(&body_, support_body_, &other_, support_other_, kIterations,
                                                    kTolerance, &distance, &a, &b);
        return apart ? distance : std::numeric_limits<double>::quiet_NaN();
    }

private:
    bool coherent_;
    CcdBody body_, other_;
    ccd_support_fn support_body_, support_other_;
};

} // namespace

void addCcd(const DistanceScene& scene, DistanceContenders& all) {
    all.push_back(std::make_unique<Ccd>(scene, "libccd", true));
    all.push_back(std::make_unique<Ccd>(scene, "libccd mapped", false));
}

} // namespace elastoon
