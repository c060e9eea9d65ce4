// The bodies, and where they are: the same for every contender and on every run.
#pragma once

#include "bench_random.h"
#include "elastoon/shape.h"

#include <cstdint>
#include <string>
#include <vector>

namespace elastoon {

struct BenchBody {
    std::string name;
    ShapePtr shape;
};
/// Each 1 m long: a box, a cylinder of 24 vertices, spheres of 66, 258 and 1026.
[[nodiscard]] const std::vector<BenchBody>& benchBodies();
/// 10 x 1 x 10 m, its top in the plane y = 0 where kFloorPose puts it.
[[nodiscard]] const ShapePtr& benchFloor();
inline const Pose kFloorPose{{0.0, -0.5, 0.0}};

/// A deforming body near another, which is fixed and rigid.
struct DistanceScene {
    std::string cell;
    BenchBody body;
    ShapePtr other;
    Pose other_pose;
    std::vector<Pose> poses;
    bool coherent = false; ///< each pose is a 60th of a second after the last, the first after the last too
};

/// A closed curve with spin, the stretch between 1/2 and 2, gaps between 0.02 and 0.2 m.
[[nodiscard]] DistanceScene coherentScene(const BenchBody& body, bool on_floor, bool quick);
/// Any place near by and any turn; gaps up to 0.5 m.
[[nodiscard]] DistanceScene randomScene(const BenchBody& body, bool on_floor, bool quick);

/// How far the body reaches from its centroid along the direction, over all vertices.
[[nodiscard]] double bruteReach(const Shape& shape, const Pose& pose, const Vec3& direction);

} // namespace elastoon
