/* Recordings through the C interface: every kind of input comes back to the bit, and what is damaged or stale is
 * refused. */
#include "c_support.h"

#include <stdlib.h>

enum { kSteps = 90, kInputKinds = 12 };

typedef struct Play {
    uint64_t hashes[kSteps + 1]; /**< before step i, without its inputs; the last one after all */
    unsigned char* bytes;
    size_t size;
    size_t input_count;
} Play;

static uint64_t hashOf(ElastoonWorld world) {
    uint64_t hash = 0;
    OK(elastoonWorldStateHash(world, &hash));
    return hash;
}

static ElastoonWorld emptyWorld(void) {
    const ElastoonWorldDef def = elastoonDefaultWorldDef();
    ElastoonWorld world = {0, 0};
    OK(elastoonWorldCreate(&def, &world));
    return world;
}

static unsigned char* bytesOf(ElastoonRecording recording, size_t* out_size) {
    OK(elastoonRecordingBytes(recording, NULL, 0, out_size));
    unsigned char* bytes = malloc(*out_size);
    REFUSED(elastoonRecordingBytes(recording, bytes, *out_size - 1, out_size), kElastoonTooSmall, "too small");
    OK(elastoonRecordingBytes(recording, bytes, *out_size, out_size));
    return bytes;
}

/** The solid of the play: what becomes of it is told to its other inputs. */
static ElastoonObstacle addLift(ElastoonWorld world) {
    ElastoonObstacleDef def = elastoonDefaultObstacleDef();
    ElastoonObstacle lift = {0, 0, {0, 0}};
    const ElastoonPathKey path[1] = {{1.0, {6.0, 3.0, 0.0}, {0.0, 0.0, 0.0, 1.0}}};
    OK(elastoonShapeBox(2.0, 0.5, 2.0, &def.shape));
    def.position = vec3(6.0, 1.0, 0.0);
    def.path = path;
    def.path_count = 1;
    OK(elastoonObstacleCreate(world, &def, &lift));
    OK(elastoonShapeDestroy(def.shape)); /* the recording keeps it */
    return lift;
}

/** What the user does before step i: every kind of input is among it. */
static size_t inputsOf(int i, ElastoonWorld world, ElastoonShape ball, ElastoonBody bodies[3], ElastoonObstacle* lift) {
    ElastoonStyle style;
    const ElastoonQuat upright = {0.0, 0.0, 0.0, 1.0};
    switch (i) {
    case 0:
        bodies[0] = addBall(world, ball, 0.0, 2.0);
        bodies[1] = addBall(world, ball, 3.0, 4.0);
        return 2;
    case 3:
        *lift = addLift(world);
        return 1;
    case 5:
        OK(elastoonNamedStyle("jelly", &style));
        OK(elastoonBodySetStyle(bodies[1], &style));
        OK(elastoonBodySetVelocity(bodies[1], vec3(1.0, 4.0, -1.0)));
        return 2;
    case 10:
        OK(elastoonBodySetPosition(bodies[1], vec3(6.0, 6.0, 0.0)));
        return 1;
    case 15:
        OK(elastoonObstacleMove(*lift, vec3(6.0, 2.0, 0.5), upright, 0.5));
        return 1;
    case 20:
        OK(elastoonObstacleSetMotion(*lift, vec3(0.0, 0.5, 0.0), vec3(0.0, 0.3, 0.0)));
        return 1;
    case 40:
        OK(elastoonObstacleSetPose(*lift, vec3(5.8, 1.5, 0.0), upright));
        return 1;
    case 50:
        OK(elastoonWorldSetGravity(world, vec3(1.0, -12.0, 0.0)));
        return 1;
    case 60:
        OK(elastoonBodyDestroy(bodies[1]));
        return 1;
    case 70:
        bodies[2] = addBall(world, ball, -4.0, 3.0); /* in the slot that was left */
        CHECK(bodies[2].slot == bodies[1].slot);
        OK(elastoonObstacleDestroy(*lift));
        return 2;
    case kSteps:
        OK(elastoonBodySetVelocity(bodies[2], vec3(0.0, 9.0, 0.0)));
        return 1;
    default:
        return 0;
    }
}

/** The first impact of the first body is led aside. */
static size_t steerOnce(ElastoonBody body, int* steered) {
    ElastoonPhaseInfo phase;
    OK(elastoonBodyPhase(body, &phase));
    if (*steered || phase.kind != kElastoonInImpact) {
        return 0;
    }
    *steered = 1;
    OK(elastoonBodySteerImpact(body, vec3(2.0, 5.0, 1.0)));
    return 1;
}

/** Records a play from its second moment on. The world goes with it; the bytes are yours. */
static Play recordPlay(void) {
    Play play;
    ElastoonShape ball;
    ElastoonRecording recording;
    ElastoonRecordingInfo info;
    ElastoonBody bodies[3];
    ElastoonObstacle lift;
    int steered = 0;
    const ElastoonWorld world = worldWithFloor(&ball);
    OK(elastoonWorldStep(world, 0.25));
    OK(elastoonRecordingBegin(world, &recording));
    play.input_count = 0;
    for (int i = 0; i <= kSteps; ++i) {
        play.hashes[i] = hashOf(world);
        play.input_count += inputsOf(i, world, ball, bodies, &lift);
        play.input_count += steerOnce(bodies[0], &steered);
        if (i < kSteps) {
            OK(elastoonWorldStep(world, i % 5 == 0 ? 1.0 / 30.0 : 1.0 / 60.0));
        }
    }
    CHECK(steered);
    play.hashes[kSteps] = hashOf(world);
    REFUSED(elastoonBodySetVelocity(bodies[0], vec3(NAN, 0.0, 0.0)), kElastoonBadArgument, "velocity");
    REFUSED(elastoonBodySetPosition(bodies[0], vec3(0.0, 0.0, 0.0)), kElastoonRefused, "inside");
    REFUSED(elastoonWorldStep(world, -1.0), kElastoonBadArgument, "dt");
    OK(elastoonRecordingInfo(recording, &info));
    CHECK(info.is_live && info.step_count == kSteps && info.input_count == play.input_count);
    OK(elastoonWorldDestroy(world));
    OK(elastoonShapeDestroy(ball));
    OK(elastoonRecordingInfo(recording, &info));
    CHECK(!info.is_live && info.step_count == kSteps);
    play.bytes = bytesOf(recording, &play.size);
    OK(elastoonRecordingDestroy(recording));
    return play;
}

static void testReplays(const Play* play) {
    ElastoonRecording recording;
    ElastoonRecordingInfo info;
    ElastoonBody bodies[2];
    uint64_t user_data = 0;
    size_t count = 0;
    const ElastoonWorld world = emptyWorld();
    CHECK(play->input_count > kInputKinds);
    OK(elastoonRecordingRead(play->bytes, play->size, &recording));
    OK(elastoonRecordingInfo(recording, &info));
    CHECK(!info.is_live && info.step_count == kSteps && info.input_count == play->input_count);
    for (int round = 0; round < 2; ++round) { /* step by step, and over what that has left */
        OK(elastoonRecordingStart(recording, world));
        for (size_t i = 0; i < kSteps; ++i) {
            CHECK(hashOf(world) == play->hashes[i]);
            OK(elastoonRecordingReplay(recording, world, i, i + 1));
        }
        CHECK(hashOf(world) != play->hashes[kSteps]); /* the last input is to come */
        OK(elastoonRecordingReplay(recording, world, kSteps, kSteps));
        CHECK(hashOf(world) != play->hashes[kSteps]);
        OK(elastoonRecordingReplay(recording, world, kSteps, kSteps + 1));
        CHECK(hashOf(world) == play->hashes[kSteps]);
    }
    OK(elastoonWorldBodies(world, bodies, 2, &count));
    CHECK(count == 2);
    OK(elastoonBodyUserData(bodies[1], &user_data));
    CHECK(user_data == 77);
    OK(elastoonRecordingStart(recording, world));
    OK(elastoonRecordingReplay(recording, world, 0, SIZE_MAX));
    CHECK(hashOf(world) == play->hashes[kSteps]);
    OK(elastoonRecordingDestroy(recording));
    OK(elastoonWorldStep(world, 0.1)); /* needs nothing of the recording's */
    OK(elastoonWorldDestroy(world));
}

/** A replay onto a world that has gone another way ends where it is told. */
static void testForeignWorld(const Play* play) {
    ElastoonRecording recording;
    ElastoonShape ball;
    const ElastoonWorld world = worldWithFloor(&ball);
    OK(elastoonRecordingRead(play->bytes, play->size, &recording));
    const ElastoonBody taken = addBall(world, ball, 0.0, 9.0);
    REFUSED(elastoonRecordingReplay(recording, world, 0, SIZE_MAX), kElastoonRefused, "step 0, addBody");
    OK(elastoonBodyDestroy(taken));
    REFUSED(elastoonRecordingReplay(recording, world, 15, 16), kElastoonRefused, "step 15, moveObstacle");
    REFUSED(elastoonRecordingReplay(recording, world, kSteps + 1, SIZE_MAX), kElastoonBadArgument, "from");
    OK(elastoonRecordingReplay(recording, world, 6, 3)); /* nothing */
    OK(elastoonWorldStep(world, 0.1));
    OK(elastoonRecordingDestroy(recording));
    OK(elastoonWorldDestroy(world));
    OK(elastoonShapeDestroy(ball));
}

static void testRewind(void) {
    ElastoonShape ball;
    ElastoonRecording recording, read;
    ElastoonRecordingInfo info;
    unsigned char snapshot[8192];
    size_t snapshot_size = 0, size = 0;
    const ElastoonWorld world = worldWithFloor(&ball);
    const ElastoonBody body = addBall(world, ball, 0.0, 3.0);
    OK(elastoonRecordingBegin(world, &recording));
    for (int i = 0; i < 20; ++i) {
        if (i == 8) {
            OK(elastoonWorldSnapshot(world, false, snapshot, sizeof snapshot, &snapshot_size));
        }
        if (i % 4 == 0) {
            OK(elastoonBodySetVelocity(body, vec3(0.1 * i, 3.0, 0.0)));
        }
        OK(elastoonWorldStep(world, 1.0 / 60.0));
    }
    REFUSED(elastoonWorldRestore(world, snapshot, snapshot_size), kElastoonRefused, "elastoonRecordingRewind");
    REFUSED(elastoonRecordingRewind(recording, 21, snapshot, snapshot_size), kElastoonBadArgument, "step");
    REFUSED(elastoonRecordingRewind(recording, 8, snapshot, snapshot_size - 1), kElastoonBadData, "");
    REFUSED(elastoonRecordingRewind(recording, 8, NULL, 0), kElastoonBadArgument, "null");
    OK(elastoonRecordingInfo(recording, &info));
    CHECK(info.step_count == 20 && info.input_count == 5);
    OK(elastoonRecordingRewind(recording, 8, snapshot, snapshot_size));
    OK(elastoonRecordingInfo(recording, &info));
    CHECK(info.is_live && info.step_count == 8 && info.input_count == 2);
    OK(elastoonBodySetVelocity(body, vec3(0.0, 7.0, 2.0))); /* the input that comes late */
    for (int i = 8; i < 20; ++i) {
        OK(elastoonWorldStep(world, 1.0 / 60.0));
    }
    const uint64_t hash = hashOf(world);
    unsigned char* bytes = bytesOf(recording, &size);
    OK(elastoonRecordingRead(bytes, size, &read));
    REFUSED(elastoonRecordingRewind(read, 8, snapshot, snapshot_size), kElastoonRefused, "no world");
    REFUSED(elastoonRecordingStart(read, world), kElastoonRefused, "being recorded");
    REFUSED(elastoonRecordingReplay(read, world, 0, 1), kElastoonRefused, "being recorded");
    CHECK(hashOf(world) == hash);
    OK(elastoonRecordingDestroy(recording)); /* from here on the world may go where it likes */
    OK(elastoonRecordingStart(read, world));
    OK(elastoonRecordingReplay(read, world, 0, SIZE_MAX));
    CHECK(hashOf(world) == hash && elastoonBodyIsValid(body));
    OK(elastoonWorldRestore(world, snapshot, snapshot_size));
    free(bytes);
    OK(elastoonRecordingDestroy(read));
    OK(elastoonWorldDestroy(world));
    OK(elastoonShapeDestroy(ball));
}

static void testBadIds(const Play* play) {
    ElastoonShape ball;
    ElastoonRecording recording, second;
    ElastoonRecordingInfo info;
    size_t size = 0;
    const ElastoonWorld none = {0, 0}, world = worldWithFloor(&ball);
    OK(elastoonRecordingBegin(world, &recording));
    REFUSED(elastoonRecordingBegin(world, &second), kElastoonRefused, "being recorded");
    const ElastoonRecording stale = recording;
    OK(elastoonRecordingDestroy(recording));
    OK(elastoonRecordingBegin(world, &recording)); /* there is room for another one */
    CHECK(recording.slot == stale.slot && elastoonRecordingIsValid(recording));
    const ElastoonRecording bad[4] = {{0, 0}, {1000000000, 3}, {recording.slot, 2}, stale};
    for (int i = 0; i < 4; ++i) {
        CHECK(!elastoonRecordingIsValid(bad[i]));
        REFUSED(elastoonRecordingInfo(bad[i], &info), kElastoonBadId, "recording");
        REFUSED(elastoonRecordingBytes(bad[i], NULL, 0, &size), kElastoonBadId, "recording");
        REFUSED(elastoonRecordingStart(bad[i], world), kElastoonBadId, "recording");
        REFUSED(elastoonRecordingReplay(bad[i], world, 0, 1), kElastoonBadId, "recording");
        REFUSED(elastoonRecordingRewind(bad[i], 0, "", 0), kElastoonBadId, "recording");
        REFUSED(elastoonRecordingDestroy(bad[i]), kElastoonBadId, "recording");
    }
    REFUSED(elastoonRecordingBegin(none, &second), kElastoonBadId, "world");
    REFUSED(elastoonRecordingBegin(world, NULL), kElastoonBadArgument, "null");
    REFUSED(elastoonRecordingInfo(recording, NULL), kElastoonBadArgument, "null");
    REFUSED(elastoonRecordingBytes(recording, NULL, 0, NULL), kElastoonBadArgument, "null");
    REFUSED(elastoonRecordingRead(NULL, 100, &second), kElastoonBadArgument, "null");
    REFUSED(elastoonRecordingRead(play->bytes, play->size, NULL), kElastoonBadArgument, "null");
    OK(elastoonRecordingRead(play->bytes, play->size, &second));
    REFUSED(elastoonRecordingStart(second, none), kElastoonBadId, "world");
    REFUSED(elastoonRecordingReplay(second, none, 0, 1), kElastoonBadId, "world");
    OK(elastoonWorldDestroy(world));
    REFUSED(elastoonRecordingStart(second, world), kElastoonBadId, "world");
    REFUSED(elastoonRecordingRewind(recording, 0, "", 0), kElastoonRefused, "no world");
    const ElastoonWorld next = worldWithFloor(&ball); /* in the slot of the world that is gone */
    OK(elastoonWorldStep(next, 0.1));
    OK(elastoonRecordingInfo(recording, &info));
    CHECK(next.slot == world.slot && !info.is_live && info.step_count == 0);
    OK(elastoonRecordingDestroy(recording));
    OK(elastoonRecordingDestroy(second));
    OK(elastoonWorldDestroy(next));
}

static void testDamage(const Play* play) {
    ElastoonRecording recording = {9, 9};
    unsigned char* damaged = malloc(play->size);
    for (size_t size = 0; size < play->size; ++size) {
        memcpy(damaged, play->bytes, size); /* where reading beyond them is noticed by a sanitizer */
        REFUSED(elastoonRecordingRead(damaged, size, &recording), kElastoonBadData, "recording");
    }
    memcpy(damaged, play->bytes, play->size);
    for (size_t i = 0; i < play->size; ++i) {
        damaged[i] ^= (unsigned char)(1U << i % 8);
        REFUSED(elastoonRecordingRead(damaged, play->size, &recording), kElastoonBadData, "recording");
        damaged[i] = play->bytes[i];
    }
    CHECK(recording.slot == 9 && recording.generation == 9);
    OK(elastoonRecordingRead(damaged, play->size, &recording));
    OK(elastoonRecordingDestroy(recording));
    free(damaged);
}

int main(void) {
    const Play play = recordPlay();
    testReplays(&play);
    testForeignWorld(&play);
    testRewind();
    testBadIds(&play);
    testDamage(&play);
    free(play.bytes);
    printf("%d failures\n", failures);
    return failures == 0 ? 0 : 1;
}
