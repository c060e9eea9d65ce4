// Bullet, float as its packages have it: a btConvexHullShape with a btBoxShape or another hull, by btGjkPairDetector,
// which its worlds use, and by the GJK of btGjkEpaSolver2, which takes a first direction from the caller.
#include "peer_bullet.h"
#include "contender.h"

#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <limits>

namespace elastoon {

BulletBody::BulletBody(const Shape& shape) {
    for (const Vec3& vertex : shape.vertices()) {
        rest_.push_back(bulletOf(vertex));
        hull_.addPoint(rest_.back(), false);
    }
    hull_.recalcLocalAabb();
    hull_.setMargin(0);
}

void BulletBody::bake(double stretch) {
    const btVector3 scale = bulletOf(scaleOf(stretch));
    btVector3* points = hull_.getUnscaledPoints();
    for (std::size_t i = 0; i < rest_.size(); ++i) {
        points[i] = rest_[i] * scale;
    }
}

std::shared_ptr<btConvexShape> bulletShape(const Shape& shape) {
    std::shared_ptr<btConvexShape> made;
    if (shape.kind() == ShapeKind::Box) {
        made = std::make_shared<btBoxShape>(bulletOf(shape.extents() * 0.5));
    } else {
        auto hull = std::make_shared<btConvexHullShape>();
        for (const Vec3& vertex : shape.vertices()) {
            hull->addPoint(bulletOf(vertex), false);
        }
        hull->recalcLocalAabb();
        made = std::move(hull);
    }
    made->setMargin(0);
    return made;
}

namespace {

class Bullet : public DistanceLoop<Bullet> {
public:
    explicit Bullet(const DistanceScene& scene)
        : DistanceLoop("Bullet", true),
          body_(*scene.body.shape),
          other_(bulletShape(*scene.other)),
          detector_(&body_.hull(), other_.get(), &solver_, nullptr) {
        input_.m_transformB = bulletOf(scene.other_pose);
    }
    void bake(const Pose& pose) { body_.bake(pose.stretch); }
    /// The detector begins every query along y; it has no other start.
    double ask(const Pose& pose) {
        input_.m_transformA = bulletOf(pose);
        btPointCollector found;
        detector_.getClosestPoints(input_, found, nullptr);
        return found.m_hasResult ? static_cast<double>(found.m_distance) : std::numeric_limits<double>::quiet_NaN();
    }

private:
    BulletBody body_;
    std::shared_ptr<btConvexShape> other_;
    btVoronoiSimplexSolver solver_;
    btGjkPairDetector detector_;
    btGjkPairDetector::ClosestPointInput input_;
};

class BulletEpa : public DistanceLoop<BulletEpa> {
public:
    explicit BulletEpa(const DistanceScene& scene)
        : DistanceLoop("Bullet epa2", true),
          coherent_(scene.coherent),
          body_(*scene.body.shape),
          other_(bulletShape(*scene.other)),
          other_transform_(bulletOf(scene.other_pose)) {}
    void bake(const Pose& pose) { body_.bake(pose.stretch); }
    double ask(const Pose& pose) {
        const btTransform transform = bulletOf(pose);
        if (!coherent_) {
            guess_ = transform.getOrigin() - other_transform_.getOrigin();
        }
        btGjkEpaSolver2::sResults found;
        const bool apart =
            btGjkEpaSolver2::Distance(&body_.hull(), transform, other_.get(), other_transform_, guess_, found);
        if (!apart) {
            return std::numeric_limits<double>::quiet_NaN();
        }
        guess_ = found.normal * found.distance;
        return static_cast<double>(found.distance);
    }

private:
    bool coherent_;
    BulletBody body_;
    std::shared_ptr<btConvexShape> other_;
    btTransform other_transform_;
    btVector3 guess_{0, 1, 0};
};

} // namespace

void addBullet(const DistanceScene& scene, DistanceContenders& all) {
    all.push_back(std::make_unique<Bullet>(scene));
    all.push_back(std::make_unique<BulletEpa>(scene));
}

} // namespace elastoon
