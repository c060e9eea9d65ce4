// How far apart two posed solids are, by the oracle and not by the code under test.
#pragma once

#include "elastoon/phase.h"
#include "oracle_solids.h"

namespace elastoon {

inline std::vector<RealVec> postured(const Shape& shape, const Pose& pose) {
    std::vector<RealVec> points;
    for (const Vec3& vertex : shape.vertices()) {
        const Vec3 p = worldFromShape(pose, vertex);
        points.push_back({p.x, p.y, p.z});
    }
    return points;
}

/// Separation by the oracle, in units of the body's length.
inline double separation(const Shape& body, const Pose& pose, const Shape& solid, const Pose& solid_pose) {
    const SolidWitness a(body);
    const SolidWitness b(solid);
    return static_cast<double>(separationBySat({&a, postured(body, pose)}, {&b, postured(solid, solid_pose)})) /
           body.length();
}

} // namespace elastoon
