// FCL, double: fcl::distance of a Convex whose vertices are rewritten in place, with a Box or a Convex.
#include "contender.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/distance.h>

#include <limits>

namespace elastoon {

namespace {

using FclVertices = std::shared_ptr<std::vector<fcl::Vector3d>>;

fcl::Transform3d transformOf(const Pose& pose) {
    fcl::Transform3d transform = fcl::Transform3d::Identity();
    const Quat& q = pose.orientation;
    transform.linear() = fcl::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix();
    transform.translation() = fcl::Vector3d(pose.position.x, pose.position.y, pose.position.z);
    return transform;
}

FclVertices verticesOf(const Shape& shape) {
    auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
    for (const Vec3& v : shape.vertices()) {
        vertices->emplace_back(v.x, v.y, v.z);
    }
    return vertices;
}

std::shared_ptr<fcl::Convexd> convexOf(const Shape& shape, const FclVertices& vertices) {
    auto faces = std::make_shared<std::vector<int>>();
    for (std::size_t i = 0; i < shape.faceCount(); ++i) {
        const auto loop = shape.face(i);
        faces->push_back(static_cast<int>(loop.size()));
        faces->insert(faces->end(), loop.begin(), loop.end());
    }
    return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(shape.faceCount()), faces);
}

class Fcl : public DistanceLoop<Fcl> {
public:
    Fcl(const DistanceScene& scene, std::string name, fcl::GJKSolverType solver)
        : DistanceLoop(std::move(name), true),
          rest_(*verticesOf(*scene.body.shape)),
          baked_(verticesOf(*scene.body.shape)),
          body_(convexOf(*scene.body.shape, baked_)),
          other_transform_(transformOf(scene.other_pose)) {
        const Vec3& size = scene.other->extents();
        if (scene.other->kind() == ShapeKind::Box) {
            other_ = std::make_shared<fcl::Boxd>(size.x, size.y, size.z);
        } else {
            other_ = convexOf(*scene.other, verticesOf(*scene.other));
        }
        request_.gjk_solver_type = solver;
    }
    void bake(const Pose& pose) {
        const Vec3 scale = scaleOf(pose.stretch);
        const fcl::Vector3d factors(scale.x, scale.y, scale.z);
        for (std::size_t i = 0; i < rest_.size(); ++i) {
            (*baked_)[i] = rest_[i].cwiseProduct(factors);
        }
    }
    double ask(const Pose& pose) {
        fcl::DistanceResultd result;
        const double distance =
            fcl::distance(body_.get(), transformOf(pose), other_.get(), other_transform_, request_, result);
        return distance > 0.0 ? distance : std::numeric_limits<double>::quiet_NaN();
    }

private:
    std::vector<fcl::Vector3d> rest_;
    FclVertices baked_;
    std::shared_ptr<fcl::Convexd> body_;
    std::shared_ptr<fcl::CollisionGeometryd> other_;
    fcl::Transform3d other_transform_;
    fcl::DistanceRequestd request_;
};

} // namespace

void addFcl(const DistanceScene& scene, DistanceContenders& all) {
    all.push_back(std::make_unique<Fcl>(scene, "FCL", fcl::GST_LIBCCD));
    all.push_back(std::make_unique<Fcl>(scene, "FCL indep", fcl::GST_INDEP));
}

} // namespace elastoon
