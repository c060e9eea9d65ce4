// Elastoon's poses and shapes for Bullet.
#pragma once

#include "elastoon/shape.h"

#include <btBulletCollisionCommon.h>

#include <memory>
#include <vector>

namespace elastoon {

inline btVector3 bulletOf(const Vec3& v) {
    return {static_cast<btScalar>(v.x), static_cast<btScalar>(v.y), static_cast<btScalar>(v.z)};
}

/// Without the stretch, which is baked.
inline btTransform bulletOf(const Pose& pose) {
    const Quat& q = pose.orientation;
    const btQuaternion turn(static_cast<btScalar>(q.x), static_cast<btScalar>(q.y), static_cast<btScalar>(q.z),
                            static_cast<btScalar>(q.w));
    return btTransform(turn, bulletOf(pose.position));
}

/// A hull whose points are rewritten in place. Bullet's own setLocalScaling would do it too, but takes longer: it finds
/// the bounds anew.
class BulletBody {
public:
    explicit BulletBody(const Shape& shape);
    void bake(double stretch);
    [[nodiscard]] const btConvexHullShape& hull() const { return hull_; }

private:
    std::vector<btVector3> rest_;
    btConvexHullShape hull_;
};

/// A box or a hull, without margin.
[[nodiscard]] std::shared_ptr<btConvexShape> bulletShape(const Shape& shape);

} // namespace elastoon
