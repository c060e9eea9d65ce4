// Elastoon's two methods. They deform on the way; their seeds live from pose to pose where the motion is coherent.
#include "closest.h"
#include "contender.h"

#include <limits>

namespace elastoon {

namespace {

class Ours : public DistanceLoop<Ours> {
public:
    Ours(const DistanceScene& scene, std::string name, ClosestMethod method)
        : DistanceLoop(std::move(name), false),
          scene_(scene),
          method_(method),
          other_{scene.other.get(), linearOf(scene.other_pose), scene.other_pose.position} {}
    void bake(const Pose& /*pose*/) {}
    double ask(const Pose& pose) {
        if (!scene_.coherent) {
            seed_ = {};
        }
        const PosedShape body{scene_.body.shape.get(), linearOf(pose), pose.position};
        const Closest closest = closestPoints(body, other_, seed_, method_);
        return closest.overlap ? std::numeric_limits<double>::quiet_NaN() : closest.distance;
    }

private:
    const DistanceScene& scene_;
    ClosestMethod method_;
    PosedShape other_;
    ClosestSeed seed_;
};

} // namespace

void addOurs(const DistanceScene& scene, DistanceContenders& all) {
    all.push_back(std::make_unique<Ours>(scene, "Elastoon V-Clip", ClosestMethod::Vclip));
    all.push_back(std::make_unique<Ours>(scene, "Elastoon GJK", ClosestMethod::Gjk));
}

} // namespace elastoon
