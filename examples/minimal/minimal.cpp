// A jelly ball falls on a floor: what it does, and where it is after four seconds.
#include <elastoon/world.h>

#include <cstdio>

int main() {
    auto world = elastoon::World::create().value();
    world.addObstacle(elastoon::ObstacleDef::plane({0, 1, 0}, 0)).value();
    elastoon::BodyDef ball;
    ball.shape = elastoon::Shape::sphere(0.5).value();
    ball.position = {0, 5, 0};
    ball.style = elastoon::styleNamed("jelly").value();
    const elastoon::BodyId id = world.addBody(ball).value();
    for (int frame = 0; frame < 240; ++frame) {
        world.step(1.0 / 60.0);
        for (const elastoon::Event& event : world.events()) {
            std::printf("%.3f s: %s\n", event.time, nameOf(event.type).data());
        }
    }
    std::printf("height %.6f\n", world.pose(id).position.y);
}
