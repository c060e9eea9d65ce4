// See casts.h.
#include "casts.h"

#include "flight.h"
#include "touch.h"

#include <limits>

namespace elastoon {

namespace {

class OurCast : public CastContender {
public:
    OurCast(const BenchBody& body, std::string name, CastMotion motion)
        : CastContender(std::move(name), motion, false), shape_(body.shape) {
        floor_.origin = kFloorPose.position;
    }
    void bakeAll(std::span<const Cast> /*casts*/) override {}
    void run(std::span<const Cast> casts, std::span<double> times) override {
        for (std::size_t i = 0; i < casts.size(); ++i) {
            ClosestSeed seed; // the casts have nothing to do with each other
            const auto touch = firstSolidTouch(casts[i].phase, *shape_, benchFloor(), floor_, 0.0, kCastStep, seed);
            times[i] = touch ? touch->time : std::numeric_limits<double>::infinity();
        }
    }

private:
    ShapePtr shape_;
    MovingFrame floor_;
};

} // namespace

CastScene castScene(const BenchBody& body, CastMotion motion, bool hits, int count) {
    CastScene scene{body, {}};
    BenchRandom random(23);
    Style style;
    style.max_stretch = 2.5;
    style.stretch_rate = 0.25;
    const double pull = motion == CastMotion::Rigid ? 0.0 : motion == CastMotion::Flight ? 9.81 : 300.0;
    for (int i = 0; i < count; ++i) {
        const double speed = random.uniform(2.0, 12.0);
        const double sideways = random.uniform(-5.0, 5.0);
        const double share = random.uniform(0.1, 0.9);
        const Vec3 velocity(sideways, hits ? -speed : -0.1 * speed, random.uniform(-5.0, 5.0));
        const Pose turned{Vec3(0.0), random.rotation(), 1.0};
        Cast cast;
        Flight flight = beginFlight(turned, velocity, {0.0, -pull, 0.0}, style, Lead::PlusX);
        const double fall = -velocity.y * kCastStep;
        // What passes must neither fall nor lengthen into the floor.
        const double lengthening = 0.0015 * pull;
        const double gap = hits ? fall * share : fall + lengthening + 0.02 + 0.2 * share;
        flight.position.y = bruteReach(*body.shape, unpushedPose(flight, 0.0), {0.0, -1.0, 0.0}) + gap;
        cast.phase.motion = flight;
        cast.from = poseAt(cast.phase, *body.shape, 0.0);
        cast.to = cast.from;
        cast.to.position += velocity * kCastStep;
        scene.casts.push_back(cast);
    }
    return scene;
}

void addOurCasts(const BenchBody& body, CastContenders& all) {
    all.push_back(std::make_unique<OurCast>(body, "Elastoon flight", CastMotion::Flight));
    all.push_back(std::make_unique<OurCast>(body, "Elastoon lively", CastMotion::Lively));
    all.push_back(std::make_unique<OurCast>(body, "Elastoon rigid", CastMotion::Rigid));
}

} // namespace elastoon
