// See bench_worlds.h.
#include "bench_worlds.h"

#include "bench_random.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace elastoon {

namespace {

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
    const double about_x = random.uniform(-tilt, tilt);
    def.rotation = Quat(1.0, about_x, 0.0, random.uniform(-tilt, tilt));
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

void addRoom(World& world, double half) {
    (void)valueOf(world.addObstacle(ObstacleDef::plane({0, 1, 0}, 0.0)));
    for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)}) {
        (void)valueOf(world.addObstacle(ObstacleDef::plane(normal, -half)));
    }
}

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

World stageBenchWorld(const BenchWorld& scene, const WorldDef& def, std::vector<BodyId>& bodies) {
    World world = valueOf(World::create(def));
    if (scene.half > 0.0) {
        addRoom(world, scene.half);
    }
    for (const ObstacleDef& obstacle : scene.obstacles) {
        (void)valueOf(world.addObstacle(obstacle));
    }
    for (BodyDef body : scene.bodies) {
        while (world.overlapOf(body)) {
            body.position.y += 1.0;
        }
        bodies.push_back(valueOf(world.addBody(body)));
    }
    return world;
}

} // namespace elastoon
