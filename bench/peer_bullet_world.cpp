// Bullet's worlds: rigid bodies of the same hulls among the same obstacles, and soft bodies. Its bodies do not meet
// each other either, do not rub, keep all of their speed, and never sleep.
#include "peer_bullet.h"
#include "worlds.h"

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>

#include <BulletSoftBody/btDefaultSoftBodySolver.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>

#include <deque>
#include <utility>

namespace elastoon {

namespace {

constexpr btScalar kStep = btScalar(1.0 / 60.0);
constexpr int kObstacle = 1;
constexpr int kBody = 2;

/// The half-spaces that a room is between: a plane's normal, into the room, and its offset along it.
std::vector<std::pair<Vec3, double>> roomOf(const BenchWorld& scene) {
    if (scene.half <= 0.0) {
        return {};
    }
    return {{{0, 1, 0}, 0.0},
            {{1, 0, 0}, -scene.half},
            {{-1, 0, 0}, -scene.half},
            {{0, 0, 1}, -scene.half},
            {{0, 0, -1}, -scene.half}};
}

class BulletWorld : public WorldContender {
public:
    explicit BulletWorld(const BenchWorld& scene)
        : dispatcher_(&configuration_), world_(&dispatcher_, &broadphase_, &solver_, &configuration_, &soft_solver_) {
        world_.setGravity(bulletOf(scene.gravity));
        world_.getWorldInfo().m_gravity = bulletOf(scene.gravity);
        world_.getWorldInfo().m_dispatcher = &dispatcher_;
        world_.getWorldInfo().m_broadphase = &broadphase_;
        world_.getWorldInfo().m_sparsesdf.Initialize();
        for (const ObstacleDef& obstacle : scene.obstacles) {
            shapes_.push_back(bulletShape(*obstacle.shape));
            const Pose pose{obstacle.position, glm::normalize(obstacle.rotation), 1.0};
            addRigid(shapes_.back().get(), 0.0, bulletOf(pose), scene);
        }
    }
    ~BulletWorld() override {
        for (btRigidBody& body : rigid_) {
            world_.removeRigidBody(&body);
        }
    }
    BulletWorld(const BulletWorld&) = delete;
    BulletWorld& operator=(const BulletWorld&) = delete;

    void step() override { world_.stepSimulation(kStep, 0); }

protected:
    btRigidBody& addRigid(btCollisionShape* shape, btScalar mass, const btTransform& transform,
                          const BenchWorld& scene) {
        btVector3 inertia(0, 0, 0);
        if (mass > 0) {
            shape->calculateLocalInertia(mass, inertia);
        }
        rigid_.emplace_back(btRigidBody::btRigidBodyConstructionInfo(mass, nullptr, shape, inertia));
        btRigidBody& body = rigid_.back();
        body.setWorldTransform(transform);
        body.setInterpolationWorldTransform(transform);
        body.setRestitution(mass > 0 ? static_cast<btScalar>(scene.style.restitution) : btScalar(1));
        body.setFriction(0);
        body.setActivationState(DISABLE_DEACTIVATION);
        world_.addRigidBody(&body, mass > 0 ? kBody : kObstacle, mass > 0 ? kObstacle : kBody);
        return body;
    }

    btSoftBodyRigidBodyCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    btDefaultSoftBodySolver soft_solver_;
    btSoftRigidDynamicsWorld world_;
    std::vector<std::shared_ptr<btCollisionShape>> shapes_;
    std::deque<btRigidBody> rigid_; ///< they stay where they are
};

class RigidWorld : public BulletWorld {
public:
    explicit RigidWorld(const BenchWorld& scene) : BulletWorld(scene) {
        for (const auto& [normal, offset] : roomOf(scene)) {
            shapes_.push_back(std::make_shared<btStaticPlaneShape>(bulletOf(normal), static_cast<btScalar>(offset)));
            addRigid(shapes_.back().get(), 0, btTransform::getIdentity(), scene);
        }
        shapes_.push_back(bulletShape(*scene.shape));
        first_ = rigid_.size();
        for (const BodyDef& def : scene.bodies) {
            btRigidBody& body =
                addRigid(shapes_.back().get(), 1, bulletOf(Pose{def.position, kNoRotation, 1.0}), scene);
            body.setLinearVelocity(bulletOf(def.velocity));
        }
        matrices_.resize(16 * scene.bodies.size());
    }
    void step() override {
        BulletWorld::step();
        for (std::size_t i = first_; i < rigid_.size(); ++i) {
            rigid_[i].getWorldTransform().getOpenGLMatrix(&matrices_[16 * (i - first_)]);
        }
    }
    [[nodiscard]] std::vector<Vec3> places() const override {
        std::vector<Vec3> places;
        for (std::size_t i = first_; i < rigid_.size(); ++i) {
            const btVector3& p = rigid_[i].getWorldTransform().getOrigin();
            places.emplace_back(p.x(), p.y(), p.z());
        }
        return places;
    }

private:
    std::size_t first_ = 0;
    std::vector<btScalar> matrices_;
};

/// Pressure makes them bounce, iterations keep them from swelling. The cheapest pair that was found with which they
/// bounce about as high as rigid bodies and ours for the first 12 s (docs/bench.md): less of either and they come to
/// lie on the floor, more pressure and they gain speed until they leave the room.
class SoftWorld : public BulletWorld {
    static constexpr btScalar kPressure = 500;
    static constexpr int kIterations = 8;

public:
    explicit SoftWorld(const BenchWorld& scene) : BulletWorld(scene) {
        addRoom(scene);
        std::vector<btVector3> points;
        for (const Vec3& vertex : scene.shape->vertices()) {
            points.push_back(bulletOf(vertex));
        }
        for (const BodyDef& def : scene.bodies) {
            btSoftBody* body = btSoftBodyHelpers::CreateFromConvexHull(world_.getWorldInfo(), points.data(),
                                                                       static_cast<int>(points.size()));
            body->m_cfg.kPR = kPressure;
            body->m_cfg.piterations = kIterations;
            body->m_cfg.kDF = 0;
            body->setTotalMass(1);
            body->translate(bulletOf(def.position));
            body->setVelocity(bulletOf(def.velocity));
            world_.addSoftBody(body, kBody, kObstacle);
            soft_.emplace_back(body);
        }
    }
    ~SoftWorld() override {
        for (const auto& body : soft_) {
            world_.removeSoftBody(body.get());
        }
    }
    SoftWorld(const SoftWorld&) = delete;
    SoftWorld& operator=(const SoftWorld&) = delete;
    [[nodiscard]] std::vector<Vec3> places() const override {
        std::vector<Vec3> places;
        for (const auto& body : soft_) {
            btVector3 sum(0, 0, 0);
            for (int i = 0; i < body->m_nodes.size(); ++i) {
                sum += body->m_nodes[i].m_x;
            }
            sum /= static_cast<btScalar>(std::max(1, body->m_nodes.size()));
            places.emplace_back(sum.x(), sum.y(), sum.z());
        }
        return places;
    }
    [[nodiscard]] double meanRadius() const override {
        const std::vector<Vec3> centres = places();
        double sum = 0.0;
        for (std::size_t k = 0; k < soft_.size(); ++k) {
            const auto& nodes = soft_[k]->m_nodes;
            double of_body = 0.0;
            for (int i = 0; i < nodes.size(); ++i) {
                const btVector3& at = nodes[i].m_x;
                of_body += glm::length(Vec3(at.x(), at.y(), at.z()) - centres[k]);
            }
            sum += of_body / std::max(1, nodes.size());
        }
        return sum / static_cast<double>(std::max<std::size_t>(1, soft_.size()));
    }

private:
    /// Of boxes: Bullet's soft bodies feel a solid by its distance field, which a plane has none of. They fall through.
    void addRoom(const BenchWorld& scene) {
        constexpr double kThick = 20.0;
        for (const auto& [normal, offset] : roomOf(scene)) {
            const Vec3 across = glm::abs(normal) * kThick;
            const Vec3 along = (Vec3(1.0) - glm::abs(normal)) * (2.0 * (scene.half + kThick) + 40.0);
            shapes_.push_back(std::make_shared<btBoxShape>(bulletOf(0.5 * (across + along))));
            btTransform place = btTransform::getIdentity();
            place.setOrigin(bulletOf(normal * (offset - 0.5 * kThick)));
            addRigid(shapes_.back().get(), 0, place, scene);
        }
    }

    std::vector<std::unique_ptr<btSoftBody>> soft_;
};

} // namespace

std::unique_ptr<WorldContender> bulletWorld(const BenchWorld& scene) {
    return std::make_unique<RigidWorld>(scene);
}

std::unique_ptr<WorldContender> bulletSoftWorld(const BenchWorld& scene) {
    return std::make_unique<SoftWorld>(scene);
}

} // namespace elastoon
