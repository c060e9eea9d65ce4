// See worlds.h: what is in them, and the library's own stepping.
#include "worlds.h"

#include "poses.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <thread>

namespace elastoon {

namespace {

constexpr double kStep = 1.0 / 60.0;

template <class T>
T valueOf(Result<T> result) {
    if (!result) {
        throw std::runtime_error(result.error().text());
    }
    return std::move(result).value();
}

ObstacleDef boxAt(const ShapePtr& shape, const Vec3& position, double tilt, BenchRandom& random) {
    ObstacleDef def;
    def.shape = shape;
    def.position = position;
    const Quat turn(1.0, random.uniform(-tilt, tilt), 0.0, random.uniform(-tilt, tilt));
    def.rotation = turn;
    return def;
}

/// A square grid over the floor, `spacing` m apart.
template <class Place>
void onGrid(double half, double spacing, Place&& place) {
    const int count = std::max(1, static_cast<int>(2.0 * half / spacing));
    for (int i = 0; i < count; ++i) {
        for (int j = 0; j < count; ++j) {
            place(Vec3(-half + spacing * (i + 0.5), 0.0, -half + spacing * (j + 0.5)));
        }
    }
}

void scatter(BenchWorld& world, std::size_t count, double low, double high, double speed, BenchRandom& random) {
    const double reach = std::max(0.0, world.half - 1.5);
    for (std::size_t i = 0; i < count; ++i) {
        BodyDef body;
        body.shape = world.shape;
        body.style = world.style;
        body.position = {random.uniform(-reach, reach), random.uniform(low, high), random.uniform(-reach, reach)};
        body.velocity = {random.uniform(-speed, speed), random.uniform(-speed, speed), random.uniform(-speed, speed)};
        world.bodies.push_back(body);
    }
}

Style bouncing() {
    Style style;
    style.restitution = 1.0;
    style.max_stretch = 1.6;
    return style;
}

void makeFlight(BenchWorld& world, std::size_t count, BenchRandom& random) {
    world.half = 0.0;
    world.style = bouncing();
    scatter(world, count, 0.0, 10.0, 20.0, random);
}

void makeRain(BenchWorld& world, std::size_t count, BenchRandom& random) {
    world.style = bouncing();
    const ShapePtr box = valueOf(Shape::box({3.0, 0.8, 3.0}));
    onGrid(world.half, 8.0,
           [&](const Vec3& foot) { world.obstacles.push_back(boxAt(box, foot + Vec3(0.0, 2.5, 0.0), 0.15, random)); });
    scatter(world, count, 5.0, 15.0, 2.0, random);
}

void makeBallpit(BenchWorld& world, std::size_t count, BenchRandom& random) {
    world.style.restitution = 0.1;
    scatter(world, count, 0.6, 1.0, 0.0, random);
}

void makePachinko(BenchWorld& world, std::size_t count, BenchRandom& random) {
    world.style = bouncing();
    world.style.restitution = 0.9;
    const ShapePtr post = valueOf(Shape::cylinder(0.2, 2.0, 12));
    for (int layer = 0; layer < 4; ++layer) {
        onGrid(world.half, 4.0, [&](const Vec3& foot) {
            world.obstacles.push_back(boxAt(post, foot + Vec3(layer % 2, 2.0 + 2.0 * layer, 0.0), 0.05, random));
        });
    }
    scatter(world, count, 11.0, 16.0, 1.0, random);
}

void makeCorners(BenchWorld& world, std::size_t count, BenchRandom& random) {
    world.style = bouncing();
    const ShapePtr box = valueOf(Shape::box({1.5, 1.5, 1.5}));
    onGrid(world.half, 3.0,
           [&](const Vec3& foot) { world.obstacles.push_back(boxAt(box, foot + Vec3(0.0, 0.5, 0.0), 0.3, random)); });
    scatter(world, count, 3.0, 6.0, 2.0, random);
}

class OurWorld : public WorldContender {
public:
    OurWorld(const BenchWorld& scene, int threads)
        : world_(valueOf(World::create({.gravity = scene.gravity, .parallel_for = onThreads(threads)}))) {
        if (scene.half > 0.0) {
            addRoom(scene.half);
        }
        for (const ObstacleDef& obstacle : scene.obstacles) {
            (void)valueOf(world_.addObstacle(obstacle));
        }
        for (BodyDef body : scene.bodies) {
            while (world_.overlapOf(body)) {
                body.position.y += 1.0;
            }
            bodies_.push_back(valueOf(world_.addBody(body)));
        }
    }
    void step() override {
        world_.step(kStep);
        matrices_ = world_.matrices();
    }
    [[nodiscard]] std::vector<Vec3> places() const override {
        std::vector<Vec3> places;
        for (const BodyId body : bodies_) {
            places.push_back(world_.pose(body).position);
        }
        return places;
    }
    [[nodiscard]] std::uint64_t hash() const override { return world_.stateHash(); }

private:
    static ParallelFor onThreads(int threads) {
        if (threads <= 1) {
            return {};
        }
        return [threads](std::size_t count, const std::function<void(std::size_t, std::size_t)>& body) {
            const auto parts = static_cast<std::size_t>(threads);
            std::vector<std::thread> crew;
            for (std::size_t i = 1; i < parts; ++i) {
                crew.emplace_back([&, i] { body(count * i / parts, count * (i + 1) / parts); });
            }
            body(0, count / parts);
            for (std::thread& worker : crew) {
                worker.join();
            }
        };
    }
    void addRoom(double half) {
        (void)valueOf(world_.addObstacle(ObstacleDef::plane({0, 1, 0}, 0.0)));
        for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)}) {
            (void)valueOf(world_.addObstacle(ObstacleDef::plane(normal, -half)));
        }
    }

    World world_;
    std::vector<BodyId> bodies_;
    std::span<const float> matrices_;
};

} // namespace

std::vector<std::string> benchWorldNames() {
    return {"flight", "rain", "ballpit", "pachinko", "corners"};
}

BenchWorld benchWorld(const std::string& name, std::size_t count) {
    BenchWorld world;
    world.name = name;
    world.shape = valueOf(Shape::sphere(0.5, 8));
    world.half = std::max(8.0, std::sqrt(static_cast<double>(count)));
    BenchRandom random(41);
    if (name == "flight") {
        makeFlight(world, count, random);
    } else if (name == "rain") {
        makeRain(world, count, random);
    } else if (name == "ballpit") {
        makeBallpit(world, count, random);
    } else if (name == "pachinko") {
        makePachinko(world, count, random);
    } else {
        makeCorners(world, count, random);
    }
    return world;
}

std::unique_ptr<WorldContender> ourWorld(const BenchWorld& scene, int threads) {
    return std::make_unique<OurWorld>(scene, threads);
}

Crowdedness lookAround(const BenchWorld& scene, const WorldContender& contender) {
    Crowdedness seen;
    const std::vector<Vec3> places = contender.places();
    for (const Vec3& place : places) {
        const bool between = std::fabs(place.x) < scene.half && std::fabs(place.z) < scene.half;
        seen.inside += scene.half == 0.0 || (between && place.y > 0.0) ? 1.0 : 0.0;
        seen.mean_height += place.y;
    }
    const double count = std::max(1.0, static_cast<double>(places.size()));
    return {seen.inside / count, seen.mean_height / count};
}

} // namespace elastoon
