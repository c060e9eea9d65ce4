/* What the C interface's tests share: checks that are counted, and a world with a floor and balls. */
#pragma once

#include <elastoon/elastoon.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

static int failures = 0;

#define CHECK(condition) check((condition) ? 1 : 0, #condition, __LINE__)
/** The call is refused with this code, and the error's text holds these words. */
#define REFUSED(call, code, words) refused((call), (code), (words), #call, __LINE__)
#define OK(call) REFUSED(call, kElastoonOk, "")

static inline void check(int holds, const char* what, int line) {
    if (!holds) {
        printf("line %d: %s does not hold\n", line, what);
        ++failures;
    }
}

static inline void refused(ElastoonResult result, ElastoonResult code, const char* words, const char* what, int line) {
    if (result != code || (code != kElastoonOk && strstr(elastoonLastError(), words) == NULL)) {
        printf("line %d: %s gives \"%s\" (%s), not \"%s\" (%s)\n", line, what, elastoonResultName(result),
               elastoonLastError(), elastoonResultName(code), words);
        ++failures;
    }
}

static inline int near(double a, double b, double tolerance) {
    return fabs(a - b) <= tolerance;
}

static inline ElastoonVec3 vec3(double x, double y, double z) {
    const ElastoonVec3 v = {x, y, z};
    return v;
}

/** A world with a floor; `out_shape` becomes a ball. */
static inline ElastoonWorld worldWithFloor(ElastoonShape* out_shape) {
    const ElastoonWorldDef def = elastoonDefaultWorldDef();
    const ElastoonObstacleDef floor_def = elastoonPlaneDef(vec3(0.0, 1.0, 0.0), 0.0);
    ElastoonWorld world = {0, 0};
    ElastoonObstacle floor = {0, 0, {0, 0}};
    OK(elastoonWorldCreate(&def, &world));
    OK(elastoonObstacleCreate(world, &floor_def, &floor));
    OK(elastoonShapeSphere(0.5, 8, out_shape));
    return world;
}

static inline ElastoonBody addBall(ElastoonWorld world, ElastoonShape shape, double x, double y) {
    ElastoonBodyDef def = elastoonDefaultBodyDef();
    ElastoonBody body = {0, 0, {0, 0}};
    def.shape = shape;
    def.position = vec3(x, y, 0.0);
    def.velocity = vec3(0.0, -3.0, 0.0);
    def.user_data = 77;
    OK(elastoonBodyCreate(world, &def, &body));
    return body;
}
