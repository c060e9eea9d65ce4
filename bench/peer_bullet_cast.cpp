// Bullet's casts of a rigid body: the subsimplex one and conservative advancement, at its own settings.
#include "casts.h"
#include "peer_bullet.h"

#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <limits>

namespace elastoon {

namespace {

enum class CastKind { Subsimplex, Continuous };

class BulletCast : public CastContender {
public:
    BulletCast(const BenchBody& body, std::string name, CastKind kind)
        : CastContender(std::move(name), CastMotion::Rigid, true),
          kind_(kind),
          body_(*body.shape),
          floor_(bulletShape(*benchFloor())),
          floor_transform_(bulletOf(kFloorPose)) {}
    void bakeAll(std::span<const Cast> casts) override {
        for (const Cast& cast : casts) {
            body_.bake(cast.from.stretch);
        }
    }
    void run(std::span<const Cast> casts, std::span<double> times) override {
        for (std::size_t i = 0; i < casts.size(); ++i) {
            body_.bake(casts[i].from.stretch);
            times[i] = kCastStep * share(casts[i]);
        }
    }

private:
    [[nodiscard]] double share(const Cast& cast) {
        if (kind_ == CastKind::Subsimplex) {
            btSubsimplexConvexCast caster(&body_.hull(), floor_.get(), &solver_);
            return shareBy(caster, cast);
        }
        btContinuousConvexCollision caster(&body_.hull(), floor_.get(), &solver_, &penetration_);
        return shareBy(caster, cast);
    }
    [[nodiscard]] double shareBy(btConvexCast& caster, const Cast& cast) const {
        btConvexCast::CastResult result;
        const bool hits =
            caster.calcTimeOfImpact(bulletOf(cast.from), bulletOf(cast.to), floor_transform_, floor_transform_, result);
        return hits ? static_cast<double>(result.m_fraction) : std::numeric_limits<double>::infinity();
    }

    CastKind kind_;
    BulletBody body_;
    std::shared_ptr<btConvexShape> floor_;
    btTransform floor_transform_;
    btVoronoiSimplexSolver solver_;
    btGjkEpaPenetrationDepthSolver penetration_;
};

} // namespace

void addBulletCasts(const BenchBody& body, CastContenders& all) {
    all.push_back(std::make_unique<BulletCast>(body, "Bullet subsimplex", CastKind::Subsimplex));
    all.push_back(std::make_unique<BulletCast>(body, "Bullet continuous", CastKind::Continuous));
}

} // namespace elastoon
