/* The C interface as a C11 program uses it: every call, what it refuses, and that it agrees with itself. */
#include "c_support.h"

#include <stdlib.h>

static void testVersionAndNames(void) {
    const ElastoonVersion version = elastoonVersion();
    CHECK(version.major == ELASTOON_VERSION_MAJOR && version.minor == ELASTOON_VERSION_MINOR &&
          version.patch == ELASTOON_VERSION_PATCH);
    CHECK(strcmp(elastoonResultName(kElastoonOk), "ok") == 0);
    CHECK(strcmp(elastoonResultName((ElastoonResult)99), "unknown") == 0);
    CHECK(strcmp(elastoonEventName(kElastoonSqueeze), "squeeze") == 0);
    CHECK(strcmp(elastoonEventName(-1), "") == 0 && strcmp(elastoonEventName(5), "") == 0);
}

static void testStyles(void) {
    ElastoonStyle style = elastoonDefaultStyle();
    ElastoonStyleParameter row;
    double value = 0.0;
    for (size_t i = 0; i < elastoonStyleParameterCount(); ++i) {
        OK(elastoonStyleParameter(i, &row));
        OK(elastoonStyleGet(&style, row.name, &value));
        CHECK(near(value, row.default_value, 1e-9));
        OK(elastoonStyleSet(&style, row.name, row.maximum));
        OK(elastoonStyleGet(&style, row.name, &value));
        CHECK(near(value, row.maximum, 1e-9 * fabs(row.maximum)));
        REFUSED(elastoonStyleSet(&style, row.name, row.maximum + 1.0), kElastoonBadArgument, row.name);
        REFUSED(elastoonStyleSet(&style, row.name, NAN), kElastoonBadArgument, row.name);
        CHECK((strchr(row.choices, ',') != NULL) ==
              (strcmp(row.name, "squash_law") == 0 || strcmp(row.name, "impact_easing") == 0 ||
               strcmp(row.name, "corner_rule") == 0));
    }
    CHECK(style.squash_law == kElastoonPaper && style.impact_easing == kElastoonLinear &&
          style.corner_rule == kElastoonBlended && near(style.rest_slope, 1.5707963267948966, 1e-12));
    REFUSED(elastoonStyleParameter(elastoonStyleParameterCount(), &row), kElastoonBadArgument, "index");
    REFUSED(elastoonStyleGet(&style, "bounce", &value), kElastoonBadArgument, "bounce");
    REFUSED(elastoonStyleGet(NULL, "friction", &value), kElastoonBadArgument, "null");
    OK(elastoonNamedStyle("jelly", &style));
    REFUSED(elastoonNamedStyle("concrete", &style), kElastoonBadArgument, "concrete");
    CHECK(elastoonNamedStyleCount() > 5);
    const char* name = NULL;
    const char* description = NULL;
    OK(elastoonNamedStyleInfo(0, &name, &description));
    CHECK(name != NULL && strcmp(name, "anvil") == 0 && strlen(description) > 5);
    REFUSED(elastoonNamedStyleInfo(1000, NULL, NULL), kElastoonBadArgument, "index");
}

static void testShapes(void) {
    ElastoonShape box, hull, other;
    ElastoonShapeInfo info;
    size_t count = 0;
    uint32_t indices[64];
    ElastoonVec3 points[8];
    OK(elastoonShapeBox(1.0, 2.0, 3.0, &box));
    OK(elastoonShapeInfo(box, &info));
    CHECK(info.kind == kElastoonBox && near(info.volume, 6.0, 1e-12) && near(info.length, 1.0, 0.0));
    OK(elastoonShapeVertices(box, NULL, 0, &count));
    CHECK(count == 8);
    REFUSED(elastoonShapeVertices(box, points, 7, &count), kElastoonTooSmall, "too small");
    OK(elastoonShapeVertices(box, points, 8, &count));
    OK(elastoonShapeTriangles(box, indices, 64, &count));
    CHECK(count == 36);
    double volume = 0.0;
    for (size_t i = 0; i < count; i += 3) {
        const ElastoonVec3 a = points[indices[i]], b = points[indices[i + 1]], c = points[indices[i + 2]];
        volume += (a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x)) / 6.0;
    }
    CHECK(near(volume, 6.0, 1e-12)); /* outward and closed */
    OK(elastoonShapeHull(points, 8, &hull));
    OK(elastoonShapeCylinder(1.0, 2.0, 32, &other));
    OK(elastoonShapeDestroy(other));
    OK(elastoonShapeCone(1.0, 2.0, 32, &other));
    OK(elastoonShapeDestroy(other));
    OK(elastoonShapeCapsule(1.0, 3.0, 16, &other));
    OK(elastoonShapeDestroy(other));
    REFUSED(elastoonShapeDestroy(other), kElastoonBadId, "shape");
    REFUSED(elastoonShapeInfo(other, &info), kElastoonBadId, "shape");
    REFUSED(elastoonShapeHull(points, 3, &other), kElastoonBadArgument, "");
    REFUSED(elastoonShapeHull(NULL, 3, &other), kElastoonBadArgument, "null");
    REFUSED(elastoonShapeSphere(-1.0, 8, &other), kElastoonBadArgument, "radius");
    REFUSED(elastoonShapeSphere(NAN, 8, &other), kElastoonBadArgument, "radius");
    REFUSED(elastoonShapeSphere(1.0, 3, &other), kElastoonBadArgument, "cuts");
    REFUSED(elastoonShapeBox(1.0, 1.0, 1.0, NULL), kElastoonBadArgument, "null");
    OK(elastoonShapeDestroy(box));
    OK(elastoonShapeDestroy(hull));
}

/** Steps a ball to rest: what the bulk calls say must agree with the single ones. */
static void testMotion(void) {
    ElastoonShape shape;
    const ElastoonWorld world = worldWithFloor(&shape);
    const ElastoonBody first = addBall(world, shape, 0.0, 2.0);
    const ElastoonBody second = addBall(world, shape, 3.0, 2.0);
    const ElastoonBody third = addBall(world, shape, 6.0, 4.0);
    OK(elastoonShapeDestroy(shape)); /* bodies keep it */
    OK(elastoonBodyDestroy(second));
    int seen[5] = {0, 0, 0, 0, 0};
    for (int step = 0; step < 1200; ++step) {
        OK(elastoonWorldStep(world, 1.0 / 60.0));
        const ElastoonEvent* events = NULL;
        size_t count = 0;
        OK(elastoonWorldEvents(world, &events, &count));
        for (size_t i = 0; i < count; ++i) {
            ++seen[events[i].type];
            CHECK(elastoonBodyIsValid(events[i].body));
            CHECK(near(events[i].normal.y, 1.0, 1e-9));
        }
        if (step % 10 != 0) {
            continue;
        }
        float matrices[3][12];
        double exact[3][12];
        double normals[3][9];
        float float_normals[3][9];
        const float* view = NULL;
        ElastoonPose pose, poses[3];
        OK(elastoonWorldMatrices(world, matrices[0], 3, &count));
        OK(elastoonWorldMatricesDouble(world, exact[0], 3, &count));
        OK(elastoonWorldNormalMatricesDouble(world, normals[0], 3, &count));
        OK(elastoonWorldNormalMatrices(world, float_normals[0], 3, &count));
        OK(elastoonWorldMatricesView(world, &view, &count));
        OK(elastoonWorldPoses(world, poses, 3, &count));
        CHECK(count == 3 && memcmp(view, matrices, sizeof matrices) == 0);
        CHECK(matrices[1][0] == 0.0F && matrices[1][11] == 0.0F); /* the free slot */
        OK(elastoonBodyPose(third, &pose));
        CHECK(memcmp(&pose, &poses[2], sizeof pose) == 0);
        CHECK(exact[2][9] == pose.position.x && exact[2][10] == pose.position.y);
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column) {
                double sum = 0.0; /* of the product of one's transpose with the other */
                for (int k = 0; k < 3; ++k) {
                    sum += exact[2][3 * row + k] * normals[2][3 * column + k];
                }
                CHECK(near(sum, row == column ? 1.0 : 0.0, 1e-12));
                CHECK(near(float_normals[2][3 * row + column], normals[2][3 * row + column], 1e-6));
            }
        }
    }
    CHECK(seen[kElastoonImpact] >= 2 && seen[kElastoonRelease] >= 2 && seen[kElastoonRest] == 2);
    ElastoonPhaseInfo phase;
    OK(elastoonBodyPhase(first, &phase));
    CHECK(phase.kind == kElastoonAtRest && elastoonObstacleIsValid(phase.obstacle));
    OK(elastoonWorldDestroy(world));
}

static void testQuestionsAndChanges(void) {
    ElastoonShape shape, again;
    const ElastoonWorld world = worldWithFloor(&shape);
    const ElastoonBody body = addBall(world, shape, 0.0, 2.0);
    ElastoonVec3 v;
    ElastoonStyle style;
    uint64_t user_data = 0;
    double time = -1.0;
    size_t count = 0;
    OK(elastoonBodyVelocity(body, &v));
    CHECK(v.y == -3.0);
    OK(elastoonBodyUserData(body, &user_data));
    CHECK(user_data == 77);
    OK(elastoonBodyShape(body, &again));
    CHECK(elastoonShapeIsValid(again) && again.slot != shape.slot);
    OK(elastoonBodyStyle(body, &style));
    style.restitution = 0.9;
    OK(elastoonBodySetStyle(body, &style));
    style.corner_rule = 2;
    REFUSED(elastoonBodySetStyle(body, &style), kElastoonBadArgument, "corner_rule");
    style.corner_rule = 0;
    style.friction = NAN;
    REFUSED(elastoonBodySetStyle(body, &style), kElastoonBadArgument, "friction");
    OK(elastoonBodySetVelocity(body, vec3(1.0, 0.0, 0.0)));
    REFUSED(elastoonBodySetVelocity(body, vec3(NAN, 0.0, 0.0)), kElastoonBadArgument, "velocity");
    OK(elastoonBodySetPosition(body, vec3(0.0, 3.0, 0.0)));
    REFUSED(elastoonBodySetPosition(body, vec3(0.0, 0.1, 0.0)), kElastoonRefused, "inside");
    OK(elastoonWorldSetGravity(world, vec3(0.0, -5.0, 0.0)));
    REFUSED(elastoonWorldSetGravity(world, vec3(0.0, INFINITY, 0.0)), kElastoonBadArgument, "gravity");
    OK(elastoonWorldGravity(world, &v));
    CHECK(v.y == -5.0);
    OK(elastoonWorldStep(world, 0.25));
    OK(elastoonWorldTime(world, &time));
    CHECK(time == 0.25);
    REFUSED(elastoonWorldStep(world, -1.0), kElastoonBadArgument, "dt");
    REFUSED(elastoonWorldStep(world, NAN), kElastoonBadArgument, "dt");
    ElastoonBody bodies[2];
    OK(elastoonWorldBodies(world, bodies, 2, &count));
    CHECK(count == 1 && memcmp(&bodies[0], &body, sizeof body) == 0);
    REFUSED(elastoonWorldBodies(world, NULL, 2, &count), kElastoonBadArgument, "null");
    REFUSED(elastoonWorldBodies(world, bodies, 2, NULL), kElastoonBadArgument, "null");
    OK(elastoonWorldDestroy(world));
}

/** What is predicted is what comes, to the bit where the steps meet it. */
static void testPrediction(void) {
    ElastoonShape shape;
    const ElastoonWorld world = worldWithFloor(&shape);
    const ElastoonBody body = addBall(world, shape, 0.0, 2.0);
    const double delays[2] = {0.5, 1.0};
    const double bad_delays[2] = {0.5, -1.0};
    ElastoonPose poses[2], pose;
    ElastoonEvent events[16];
    const ElastoonEvent* happened = NULL;
    size_t count = 0, happened_count = 0;
    OK(elastoonBodyPredictPoses(body, delays, 2, poses));
    OK(elastoonBodyPredictEvents(body, 1.0, events, 16, &count));
    CHECK(count >= 2);
    REFUSED(elastoonBodyPredictPoses(body, bad_delays, 2, poses), kElastoonBadArgument, "delays");
    REFUSED(elastoonBodyPredictEvents(body, NAN, events, 16, &count), kElastoonBadArgument, "horizon");
    OK(elastoonWorldStep(world, 1.0));
    OK(elastoonBodyPose(body, &pose));
    CHECK(memcmp(&pose, &poses[1], sizeof pose) == 0);
    OK(elastoonWorldEvents(world, &happened, &happened_count));
    CHECK(happened_count == count && happened[0].time == events[0].time);
    OK(elastoonWorldDestroy(world));
}

static void testObstacles(void) {
    ElastoonShape ball, box, shape;
    const ElastoonWorld world = worldWithFloor(&ball);
    ElastoonObstacle all[4];
    ElastoonObstacleFrame frame;
    ElastoonVec3 normal;
    size_t count = 0;
    OK(elastoonWorldObstacles(world, all, 4, &count));
    CHECK(count == 1);
    OK(elastoonObstaclePlaneNormal(all[0], &normal));
    CHECK(normal.y == 1.0);
    OK(elastoonObstacleShape(all[0], &shape));
    CHECK(shape.slot == 0);
    OK(elastoonShapeBox(2.0, 1.0, 2.0, &box));
    ElastoonObstacleDef def = elastoonDefaultObstacleDef();
    const ElastoonPathKey path[2] = {{1.0, {0.0, 6.0, 0.0}, {0.0, 0.0, 0.0, 1.0}},
                                     {2.0, {0.0, 5.0, 0.0}, {0.0, 0.0, 0.0, 1.0}}};
    def.shape = box;
    def.position = vec3(0.0, 5.0, 0.0);
    def.path = path;
    def.path_count = 2;
    def.path_repeats = true;
    CHECK(def.user_data == 0);
    def.user_data = 0xfedcba9876543210u;
    ElastoonObstacle lift;
    uint64_t user_data = 1;
    OK(elastoonObstacleCreate(world, &def, &lift));
    OK(elastoonObstacleUserData(lift, &user_data));
    CHECK(user_data == 0xfedcba9876543210u);
    OK(elastoonObstacleUserData(all[0], &user_data));
    CHECK(user_data == 0);
    REFUSED(elastoonObstacleUserData(lift, NULL), kElastoonBadArgument, "out_user_data");
    OK(elastoonWorldStep(world, 0.5));
    OK(elastoonObstacleFrame(lift, &frame));
    CHECK(near(frame.position.y, 5.5, 1e-12) && near(frame.velocity.y, 1.0, 1e-12));
    OK(elastoonObstacleMove(lift, vec3(0.0, 9.0, 0.0), def.rotation, 0.5));
    REFUSED(elastoonObstacleMove(lift, vec3(0.0, 9.0, 0.0), def.rotation, 0.0), kElastoonBadArgument, "");
    OK(elastoonObstacleSetMotion(lift, vec3(1.0, 0.0, 0.0), vec3(0.0, 0.0, 0.0)));
    REFUSED(elastoonObstacleSetMotion(lift, vec3(NAN, 0.0, 0.0), vec3(0.0, 0.0, 0.0)), kElastoonBadArgument, "");
    OK(elastoonObstacleSetPose(lift, vec3(0.0, 4.0, 0.0), def.rotation));
    OK(elastoonObstacleFrame(lift, &frame));
    CHECK(frame.position.y == 4.0 && frame.velocity.x == 0.0);
    REFUSED(elastoonObstaclePlaneNormal(lift, &normal), kElastoonRefused, "solid");
    ElastoonBodyDef body_def = elastoonDefaultBodyDef();
    ElastoonOverlap overlap;
    body_def.shape = ball;
    body_def.position = vec3(0.0, 4.0, 0.0);
    OK(elastoonWorldOverlap(world, &body_def, &overlap));
    CHECK(overlap.obstacle.slot == lift.slot && overlap.depth > 0.1);
    body_def.position = vec3(0.0, 20.0, 0.0);
    OK(elastoonWorldOverlap(world, &body_def, &overlap));
    CHECK(overlap.obstacle.slot == 0);
    def.path = NULL;
    REFUSED(elastoonObstacleCreate(world, &def, &lift), kElastoonBadArgument, "path");
    OK(elastoonObstacleDestroy(lift));
    REFUSED(elastoonObstacleDestroy(lift), kElastoonBadId, "obstacle");
    REFUSED(elastoonObstacleFrame(lift, &frame), kElastoonBadId, "obstacle");
    REFUSED(elastoonObstacleUserData(lift, &user_data), kElastoonBadId, "obstacle");
    OK(elastoonWorldDestroy(world));
}

/** Null, stale and foreign ids, wherever an id is taken. */
static void testBadIds(void) {
    ElastoonShape shape;
    const ElastoonWorld none = {0, 0}, made_up = {1000000000, 3}, even = {1, 2};
    const ElastoonWorld world = worldWithFloor(&shape);
    const ElastoonBody body = addBall(world, shape, 0.0, 2.0);
    ElastoonBody foreign = body, stale = body;
    ElastoonPose pose;
    ElastoonBodyDef def = elastoonDefaultBodyDef();
    ElastoonBody out;
    size_t count = 0;
    const ElastoonWorld bad[3] = {none, made_up, even};
    for (int i = 0; i < 3; ++i) {
        foreign.world = bad[i];
        REFUSED(elastoonBodyPose(foreign, &pose), kElastoonBadId, "body");
        REFUSED(elastoonWorldStep(bad[i], 0.1), kElastoonBadId, "world");
        REFUSED(elastoonWorldBodies(bad[i], NULL, 0, &count), kElastoonBadId, "world");
        REFUSED(elastoonWorldDestroy(bad[i]), kElastoonBadId, "world");
        REFUSED(elastoonBodyCreate(bad[i], &def, &out), kElastoonBadId, "world");
        CHECK(!elastoonWorldIsValid(bad[i]) && !elastoonBodyIsValid(foreign));
    }
    REFUSED(elastoonBodyCreate(world, &def, &out), kElastoonBadId, "shape");
    REFUSED(elastoonBodyCreate(world, NULL, &out), kElastoonBadArgument, "null");
    def.shape = shape;
    def.position.x = NAN;
    REFUSED(elastoonBodyCreate(world, &def, &out), kElastoonBadArgument, "position");
    def.position.x = 0.0;
    REFUSED(elastoonBodyCreate(world, &def, &out), kElastoonRefused, "inside");
    REFUSED(elastoonBodyPose(body, NULL), kElastoonBadArgument, "null");
    OK(elastoonBodyDestroy(body));
    REFUSED(elastoonBodyPose(stale, &pose), kElastoonBadId, "body");
    const ElastoonBody reused = addBall(world, shape, 0.0, 2.0);
    CHECK(reused.slot == stale.slot);
    REFUSED(elastoonBodyDestroy(stale), kElastoonBadId, "body");
    OK(elastoonBodyPose(reused, &pose));
    OK(elastoonWorldDestroy(world));
    REFUSED(elastoonBodyPose(reused, &pose), kElastoonBadId, "body");
    const ElastoonWorld next = worldWithFloor(&shape);
    CHECK(next.slot == world.slot && next.generation != world.generation);
    REFUSED(elastoonBodyPose(reused, &pose), kElastoonBadId, "body");
    OK(elastoonWorldDestroy(next));
}

static void testSnapshot(void) {
    ElastoonShape shape;
    const ElastoonWorld world = worldWithFloor(&shape);
    const ElastoonBody body = addBall(world, shape, 0.0, 2.0);
    uint64_t before = 0, after = 0;
    size_t size = 0;
    OK(elastoonWorldStep(world, 0.7));
    OK(elastoonWorldSnapshot(world, true, NULL, 0, &size));
    unsigned char* bytes = malloc(size);
    REFUSED(elastoonWorldSnapshot(world, true, bytes, size - 1, &size), kElastoonTooSmall, "too small");
    OK(elastoonWorldSnapshot(world, true, bytes, size, &size));
    OK(elastoonWorldStep(world, 1.0));
    OK(elastoonWorldStateHash(world, &before));
    OK(elastoonWorldRestore(world, bytes, size));
    OK(elastoonWorldStep(world, 1.0));
    OK(elastoonWorldStateHash(world, &after));
    CHECK(before == after && elastoonBodyIsValid(body));
    bytes[size / 2] ^= 1;
    REFUSED(elastoonWorldRestore(world, bytes, size), kElastoonBadData, "");
    REFUSED(elastoonWorldRestore(world, bytes, 3), kElastoonBadData, "");
    REFUSED(elastoonWorldRestore(world, NULL, size), kElastoonBadArgument, "null");
    OK(elastoonWorldStateHash(world, &after));
    CHECK(before == after);
    free(bytes);
    OK(elastoonWorldDestroy(world));
}

static int parts = 0;

static void backwards(void* context, size_t count, ElastoonRangeFunction part, void* part_context) {
    *(size_t*)context = count;
    for (size_t i = count; i > 0; --i) {
        part(part_context, i - 1, i);
        ++parts;
    }
}

static void testParallelFor(void) {
    uint64_t hashes[2] = {0, 1};
    size_t bodies = 0;
    for (int with = 0; with < 2; ++with) {
        ElastoonShape shape;
        const ElastoonWorld plain = worldWithFloor(&shape);
        ElastoonWorldDef def = elastoonDefaultWorldDef();
        const ElastoonObstacleDef floor_def = elastoonPlaneDef(vec3(0.0, 1.0, 0.0), 0.0);
        ElastoonWorld world;
        ElastoonObstacle floor;
        def.parallel_for = with ? backwards : NULL;
        def.parallel_context = &bodies;
        OK(elastoonWorldCreate(&def, &world));
        OK(elastoonObstacleCreate(world, &floor_def, &floor));
        for (int i = 0; i < 5; ++i) {
            addBall(world, shape, 2.0 * i, 2.0 + 0.1 * i);
        }
        OK(elastoonWorldStep(world, 2.0));
        OK(elastoonWorldStateHash(world, &hashes[with]));
        OK(elastoonWorldDestroy(world));
        OK(elastoonWorldDestroy(plain));
    }
    CHECK(hashes[0] == hashes[1] && bodies == 5 && parts == 5);
}

static const char kSceneText[] =
    "{\"elastoon\":1,\"name\":\"two\",\"duration\":2,"
    "\"shapes\":{\"ball\":{\"type\":\"sphere\",\"radius\":0.5},\"box\":{\"type\":\"box\",\"size\":[1,1,1]}},"
    "\"bodies\":[{\"name\":\"b\",\"shape\":\"ball\",\"style\":\"jelly\",\"position\":[0,5,0],\"color\":\"#ff0000\"}],"
    "\"obstacles\":[{\"type\":\"plane\",\"normal\":[0,1,0]},"
    "{\"name\":\"lift\",\"shape\":\"box\",\"position\":[9,1,0],\"path\":[{\"time\":1,\"position\":[9,2,0]}]}],"
    "\"camera\":{\"eye\":[0,2,9],\"target\":[0,1,0]}}";

static void testScenes(void) {
    ElastoonScene scene;
    ElastoonSceneInfo info;
    ElastoonSceneBody body;
    ElastoonSceneObstacle obstacle;
    ElastoonShape shape;
    ElastoonWorld world;
    const char* name = NULL;
    double value = 0.0;
    OK(elastoonSceneParse(kSceneText, strlen(kSceneText), "two.json", &scene));
    OK(elastoonSceneInfo(scene, &info));
    CHECK(strcmp(info.name, "two") == 0 && info.duration == 2.0 && info.shape_count == 2 && info.body_count == 1 &&
          info.obstacle_count == 2 && info.has_camera && info.camera_eye.z == 9.0);
    OK(elastoonSceneBody(scene, 0, &body));
    CHECK(strcmp(body.name, "b") == 0 && body.color.x == 1.0 && body.color.y == 0.0 && body.def.position.y == 5.0);
    OK(elastoonSceneShape(scene, body.shape, &name, &shape));
    CHECK(strcmp(name, "ball") == 0 && shape.slot == body.def.shape.slot && elastoonShapeIsValid(shape));
    OK(elastoonSceneObstacle(scene, 1, &obstacle));
    CHECK(obstacle.has_shape && obstacle.def.path_count == 1 && obstacle.def.path[0].position.y == 2.0);
    OK(elastoonStyleGet(&body.def.style, "max_stretch", &value));
    REFUSED(elastoonSceneBody(scene, 1, &body), kElastoonBadArgument, "index");
    REFUSED(elastoonSceneObstacle(scene, 2, &obstacle), kElastoonBadArgument, "index");
    REFUSED(elastoonSceneShape(scene, 2, NULL, &shape), kElastoonBadArgument, "index");
    ElastoonObstacleFrame frame;
    OK(elastoonSceneObstacleFrame(scene, 1, 0.5, &frame));
    CHECK(near(frame.position.y, 1.5, 1e-12) && frame.velocity.y == 1.0);
    REFUSED(elastoonSceneObstacleFrame(scene, 2, 0.5, &frame), kElastoonBadArgument, "index");
    REFUSED(elastoonSceneObstacleFrame(scene, 1, -1.0, &frame), kElastoonBadArgument, "time");
    OK(elastoonSceneStage(scene, &world));
    OK(elastoonSceneDestroy(scene));
    CHECK(!elastoonShapeIsValid(shape) && !elastoonSceneIsValid(scene));
    REFUSED(elastoonSceneStage(scene, &world), kElastoonBadId, "scene");
    OK(elastoonWorldStep(world, 2.0)); /* needs nothing of the scene's */
    OK(elastoonWorldDestroy(world));
    REFUSED(elastoonSceneParse("{\"elastoon\":1,\"bodys\":[]}", 25, "bad.json", &scene), kElastoonBadData, "bodies");
    REFUSED(elastoonSceneParse("{\"elastoon\":", 12, NULL, &scene), kElastoonBadData, "line 1");
    REFUSED(elastoonSceneParse(NULL, 0, NULL, &scene), kElastoonBadArgument, "null");
}

static void testTimeline(void) {
    ElastoonShape shape;
    const ElastoonWorld world = worldWithFloor(&shape);
    const ElastoonBody first = addBall(world, shape, 0.0, 3.0);
    ElastoonBody late = {0, 0, {0, 0}};
    ElastoonTimeline timeline;
    ElastoonTimelineInfo info;
    ElastoonPose seen[120], pose;
    ElastoonVec3 velocity;
    float matrices[24];
    const ElastoonEvent* events = NULL;
    size_t count = 0;
    OK(elastoonTimelineBegin(world, &timeline));
    for (int i = 0; i < 120; ++i) {
        if (i == 60) {
            late = addBall(world, shape, 4.0, 3.0);
        }
        OK(elastoonWorldStep(world, 1.0 / 60.0));
        OK(elastoonTimelineCapture(timeline));
        OK(elastoonBodyPose(first, &seen[i]));
    }
    OK(elastoonTimelineInfo(timeline, &info));
    CHECK(info.start == 0.0 && info.capture_count == 120 && near(info.end, 2.0, 1e-12));
    for (int i = 119; i >= 0; --i) {
        double time = 0.0;
        for (int step = 0; step <= i; ++step) {
            time += 1.0 / 60.0;
        }
        OK(elastoonTimelinePoses(timeline, first, &time, 1, &pose, &velocity));
        CHECK(pose.position.y == seen[i].position.y && pose.stretch == seen[i].stretch);
    }
    OK(elastoonTimelineMatrices(timeline, 0.5, NULL, 0, &count));
    CHECK(count == 2);
    OK(elastoonTimelineMatrices(timeline, 0.5, matrices, 2, &count));
    CHECK(matrices[0] != 0.0F && matrices[12] == 0.0F);
    OK(elastoonTimelineMatrices(timeline, info.end, matrices, 2, &count));
    CHECK(matrices[12] != 0.0F && near(matrices[10], seen[119].position.y, 1e-6));
    OK(elastoonTimelineEvents(timeline, &events, &count));
    CHECK(count >= 2 && events[0].type == kElastoonImpact && events[0].body.slot == first.slot);
    OK(elastoonTimelineCut(timeline, 0));
    OK(elastoonTimelineEvents(timeline, &events, &count));
    CHECK(count == 0);
    REFUSED(elastoonTimelinePoses(timeline, late, NULL, 0, NULL, NULL), kElastoonBadId, "body");
    REFUSED(elastoonTimelineMatrices(timeline, NAN, NULL, 0, &count), kElastoonBadArgument, "time");
    REFUSED(elastoonTimelineMatrices(timeline, 0.0, matrices, 0, &count), kElastoonTooSmall, "small");
    REFUSED(elastoonTimelineBegin(world, NULL), kElastoonBadArgument, "null");
    OK(elastoonWorldDestroy(world));
    REFUSED(elastoonTimelineCapture(timeline), kElastoonBadId, "world");
    OK(elastoonTimelineDestroy(timeline));
    CHECK(!elastoonTimelineIsValid(timeline));
    REFUSED(elastoonTimelineInfo(timeline, &info), kElastoonBadId, "timeline");
}

/** The check figures of docs/model.md. */
static void testCurves(void) {
    ElastoonStyle style = elastoonDefaultStyle();
    ElastoonImpactInput input = {1.0, 14.007, 0.0, 7.0035, 0.0, 0.0, false};
    ElastoonImpactCurve curve;
    double s[3];
    style.squash_law = kElastoonPaper;
    OK(elastoonStretchAtSpeed(&style, input.speed_in, &input.s_in));
    OK(elastoonStretchAtSpeed(&style, input.speed_out, &input.s_out));
    OK(elastoonImpactCurve(&style, &input, &curve));
    CHECK(near(curve.s_in, 1.5835, 1e-4) && near(curve.s_mid, 0.6041, 1e-4) && near(curve.t_in, 0.1098, 1e-4) &&
          near(curve.s_out, 1.4119, 1e-4) && near(curve.t_out, 0.1812, 1e-4));
    const double times[3] = {0.0, curve.t_in, curve.t_in + curve.t_out};
    OK(elastoonImpactCurveAt(&curve, times, 3, s));
    CHECK(near(s[0], curve.s_in, 1e-12) && near(s[1], curve.s_mid, 1e-9) && near(s[2], curve.s_out, 1e-9));
    input.length = 0.0;
    REFUSED(elastoonImpactCurve(&style, &input, &curve), kElastoonBadArgument, "length");
    style.max_stretch = 0.0;
    REFUSED(elastoonStretchAtSpeed(&style, 1.0, &s[0]), kElastoonBadArgument, "max_stretch");
    REFUSED(elastoonStretchAtSpeed(NULL, 1.0, &s[0]), kElastoonBadArgument, "null");
}

int main(void) {
    testVersionAndNames();
    testStyles();
    testShapes();
    testMotion();
    testQuestionsAndChanges();
    testPrediction();
    testObstacles();
    testBadIds();
    testSnapshot();
    testParallelFor();
    testScenes();
    testTimeline();
    testCurves();
    printf("%d failures\n", failures);
    return failures == 0 ? 0 : 1;
}
