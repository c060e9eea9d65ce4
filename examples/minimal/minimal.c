/* The same in C. */
#include <elastoon/elastoon.h>

#include <stdio.h>

int main(void) {
    const ElastoonWorldDef world_def = elastoonDefaultWorldDef();
    const ElastoonVec3 up = {0, 1, 0};
    const ElastoonObstacleDef floor_def = elastoonPlaneDef(up, 0);
    ElastoonBodyDef def = elastoonDefaultBodyDef();
    ElastoonWorld world;
    ElastoonObstacle floor;
    ElastoonBody body;
    ElastoonPose pose;
    def.position.y = 5;
    if (elastoonWorldCreate(&world_def, &world) || elastoonObstacleCreate(world, &floor_def, &floor) ||
        elastoonShapeSphere(0.5, 8, &def.shape) || elastoonNamedStyle("jelly", &def.style) ||
        elastoonBodyCreate(world, &def, &body)) {
        fprintf(stderr, "%s\n", elastoonLastError());
        return 1;
    }
    for (int frame = 0; frame < 240; ++frame) {
        const ElastoonEvent* events;
        size_t count;
        elastoonWorldStep(world, 1.0 / 60.0);
        elastoonWorldEvents(world, &events, &count);
        for (size_t i = 0; i < count; ++i) {
            printf("%.3f s: %s\n", events[i].time, elastoonEventName(events[i].type));
        }
    }
    elastoonBodyPose(body, &pose);
    printf("height %.6f\n", pose.position.y);
    elastoonWorldDestroy(world);
    return 0;
}
