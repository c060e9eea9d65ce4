/* The C interface: all of the library for C11 and for whatever speaks to C. docs/c-interface.md has examples.

   - Things are named by small ids that are passed by value. A zeroed id names nothing. An id of something that is gone
     stays invalid, also when its place is used again.
   - A call that can be refused returns an ElastoonResult; kElastoonOk is 0. elastoonLastError() tells why, as a text.
     What a refused call would have written stays as it was, unless it says otherwise. Null where a pointer is needed,
     ids of nothing, and numbers that are not finite are refused, never fatal.
   - Definition structs come from elastoonDefault...(): change what you want to, and pass them.
   - Lengths in m, times in s, angles in rad, as doubles. Quaternions are x y z w, of any length but zero.
   - Lists are written to your array: `capacity` is its size in items, `*out_count` becomes the number of items that
   there are. With a null array and capacity 0 you ask for the number alone; an array too small is kElastoonTooSmall,
   and is left as it was.
   - One call at a time on one world; different worlds may be used from different threads. */
#ifndef ELASTOON_ELASTOON_H
#define ELASTOON_ELASTOON_H

#include "elastoon/export.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Versions and errors ---- */

#define ELASTOON_VERSION_MAJOR 0
#define ELASTOON_VERSION_MINOR 1
#define ELASTOON_VERSION_PATCH 0

typedef struct ElastoonVersion {
    int32_t major, minor, patch;
} ElastoonVersion;

/** Version of the library that is linked; the macros are those of this header. */
ELASTOON_API ElastoonVersion elastoonVersion(void);

#ifdef __cplusplus
#define ELASTOON_ANY_INT : int32_t /* so that a number that is none of the codes is one in C++ too */
#else
#define ELASTOON_ANY_INT
#endif

typedef enum ElastoonResult ELASTOON_ANY_INT {
    kElastoonOk = 0,
    kElastoonBadId,       /**< the id names nothing: null, of something that is gone, or made up */
    kElastoonBadArgument, /**< a null pointer, a number that is not finite or out of range, an unknown name */
    kElastoonRefused,     /**< sound in itself, but not here: a body that starts inside an obstacle */
    kElastoonTooSmall,    /**< your array is too small; *out_count says what is needed */
    kElastoonBadData,     /**< a snapshot, a recording or a scene that is damaged or wrong */
    kElastoonOutOfMemory, /**< the state of the world that was called is not known any more: destroy it */
} ElastoonResult;

/** What went wrong in the last call of this thread that did: what, where, and what would be right. Valid until the next
    one that fails; empty if none has. */
ELASTOON_API const char* elastoonLastError(void);
/** "ok", "bad id", ... */
ELASTOON_API const char* elastoonResultName(ElastoonResult result);

/* ---- Plain values ---- */

typedef struct ElastoonVec3 {
    double x, y, z;
} ElastoonVec3;

typedef struct ElastoonQuat {
    double x, y, z, w;
} ElastoonQuat;

/** x = position + R diag(s, 1/sqrt(s), 1/sqrt(s)) X for a point X of the shape. */
typedef struct ElastoonPose {
    ElastoonVec3 position; /**< of the shape's volume centroid, m */
    ElastoonQuat orientation; /**< R, unit; its x axis is the principal axis */
    double stretch; /**< s, > 0 */
} ElastoonPose;

typedef struct ElastoonWorld {
    uint32_t slot, generation;
} ElastoonWorld;

typedef struct ElastoonShape {
    uint32_t slot, generation;
} ElastoonShape;

typedef struct ElastoonScene {
    uint32_t slot, generation;
} ElastoonScene;

/** `slot` - 1 is the body's place in the bulk arrays for as long as it lives. */
typedef struct ElastoonBody {
    uint32_t slot, generation;
    ElastoonWorld world;
} ElastoonBody;

typedef struct ElastoonObstacle {
    uint32_t slot, generation;
    ElastoonWorld world;
} ElastoonObstacle;

/* ---- Styles ---- */

typedef enum ElastoonSquashLaw { kElastoonBounded = 0, kElastoonPaper } ElastoonSquashLaw;
typedef enum ElastoonImpactEasing { kElastoonSmooth = 0, kElastoonLinear } ElastoonImpactEasing;
typedef enum ElastoonCornerRule { kElastoonQueued = 0, kElastoonBlended } ElastoonCornerRule;

/** rest_speed that says "derive it from the body": a hop of 2 % of its length. */
#define ELASTOON_DERIVED (-1.0)

/** How a body moves. Ranges, defaults and meanings: elastoonStyleParameter(), or docs/model.md. */
typedef struct ElastoonStyle {
    double restitution; /**< share of the normal speed that is kept; 0.5 */
    double max_stretch; /**< stretch approached at infinite speed, >= 1; 2 */
    double min_squash; /**< length left in the hardest hit, 0 to 1; 0.5 */
    double stretch_rate; /**< s/m: half of the stretch is reached at speed 1/stretch_rate; 0.1 */
    double squash_rate; /**< how fast an impact runs; 1 */
    double reversal_rate; /**< fastest turn at the top of a steep throw, rad/s; 4 pi */
    double rest_speed; /**< m/s, or ELASTOON_DERIVED, which is the default */
    double rest_slope; /**< steepest surface that holds a body at rest, rad; 35 degrees */
    double friction; /**< of a slide; 0.4 */
    double grazing_angle; /**< incidence below which a touch skips, rad; 30 degrees */
    int32_t squash_law; /**< ElastoonSquashLaw; bounded */
    int32_t impact_easing; /**< ElastoonImpactEasing; smooth */
    int32_t corner_rule; /**< ElastoonCornerRule; queued */
} ElastoonStyle;

/** One row of the parameter table. Values are in the unit of files: angles in degrees. */
typedef struct ElastoonStyleParameter {
    const char* name; /**< field of ElastoonStyle, key in scene files */
    const char* symbol; /**< as docs/model.md writes it; may be empty */
    const char* unit; /**< empty for a pure number */
    const char* meaning; /**< one line */
    const char*
        choices; /**< names of a choice with commas between them, in the order of its enum; empty for a number */
    double minimum, maximum, default_value;
    bool may_be_derived; /**< takes ELASTOON_DERIVED as well */
} ElastoonStyleParameter;

ELASTOON_API ElastoonStyle elastoonDefaultStyle(void);
ELASTOON_API size_t elastoonStyleParameterCount(void);
/** The texts live as long as the library. */
ELASTOON_API ElastoonResult elastoonStyleParameter(size_t index, ElastoonStyleParameter* out_parameter);
/** The parameter of this name, in the unit of files; the index of a choice. */
ELASTOON_API ElastoonResult elastoonStyleGet(const ElastoonStyle* style, const char* name, double* out_value);
ELASTOON_API ElastoonResult elastoonStyleSet(ElastoonStyle* style, const char* name, double value);
/** The styles that come with the library ("jelly", "anvil", ...), by name. */
ELASTOON_API size_t elastoonNamedStyleCount(void);
/** Name and one-line description, which live as long as the library; either pointer may be null. */
ELASTOON_API ElastoonResult elastoonNamedStyleInfo(size_t index, const char** out_name, const char** out_description);
ELASTOON_API ElastoonResult elastoonNamedStyle(const char* name, ElastoonStyle* out_style);

/** What an impact's curve is made from: docs/model.md. */
typedef struct ElastoonImpactInput {
    double length; /**< of the body along its principal axis, m */
    double speed_in; /**< relative to the surface, m/s */
    double s_in; /**< stretch at the touch */
    double speed_out; /**< after it, m/s */
    double s_out; /**< stretch of what follows */
    double rest_speed; /**< m/s; 0 is good where it is not known */
    bool turns; /**< the body has to turn, which takes time even where nothing squashes */
} ElastoonImpactInput;

/** Stretch through an impact: a sine from s_in down to s_mid in t_in, a cosine up to s_out in t_out. */
typedef struct ElastoonImpactCurve {
    double s_in, s_mid, s_out;
    double omega_in, omega_out; /**< rad/s; 0 where the half takes no time */
    double t_in, t_out; /**< s */
} ElastoonImpactCurve;

/** Stretch of a body that flies at this speed, m/s (>= 0). */
ELASTOON_API ElastoonResult elastoonStretchAtSpeed(const ElastoonStyle* style, double speed, double* out_stretch);
ELASTOON_API ElastoonResult elastoonImpactCurve(const ElastoonStyle* style, const ElastoonImpactInput* input,
                                                ElastoonImpactCurve* out_curve);
/** The stretch at each of the times after the touch; the ends hold before and after. */
ELASTOON_API ElastoonResult elastoonImpactCurveAt(const ElastoonImpactCurve* curve, const double* times, size_t count,
                                                  double* out_stretches);

/* ---- Shapes: convex, about their volume centroid, principal axis along x ---- */

typedef enum ElastoonShapeKind {
    kElastoonSphere = 0,
    kElastoonBox,
    kElastoonCylinder,
    kElastoonCone,
    kElastoonCapsule,
    kElastoonHull,
} ElastoonShapeKind;

typedef struct ElastoonShapeInfo {
    int32_t kind; /**< ElastoonShapeKind */
    double length; /**< along the principal axis, m */
    double volume; /**< m^3 */
    double radius; /**< that it was made with, else 0 */
    double bounding_radius;
    ElastoonVec3 extents; /**< full, along x, y, z */
    ElastoonVec3 centroid_of_input; /**< where the centroid lay among the points given to elastoonShapeHull */
    uint64_t content_hash; /**< equal for shapes that were made alike, on every machine */
} ElastoonShapeInfo;

/** Sizes within 1e-9 to 1e9 m. An octahedron's faces cut in `cuts` (a multiple of 2, 2 to 64; 8 is good). */
ELASTOON_API ElastoonResult elastoonShapeSphere(double radius, int32_t cuts, ElastoonShape* out_shape);
/** Full edge lengths. */
ELASTOON_API ElastoonResult elastoonShapeBox(double x, double y, double z, ElastoonShape* out_shape);
/** Along x; `sides` a multiple of 4, 8 to 256 (32 is good). */
ELASTOON_API ElastoonResult elastoonShapeCylinder(double radius, double length, int32_t sides,
                                                  ElastoonShape* out_shape);
/** Its tip towards +x; `sides` as above. */
ELASTOON_API ElastoonResult elastoonShapeCone(double radius, double length, int32_t sides, ElastoonShape* out_shape);
/** `length` from tip to tip, at least 2 radius; `sides` a multiple of 4, 8 to 64 (16 is good). */
ELASTOON_API ElastoonResult elastoonShapeCapsule(double radius, double length, int32_t sides, ElastoonShape* out_shape);
/** The convex hull of the points, moved so that its centroid is the origin. */
ELASTOON_API ElastoonResult elastoonShapeHull(const ElastoonVec3* points, size_t count, ElastoonShape* out_shape);
/** Gives the id back. Bodies, obstacles and scenes of this shape keep it. */
ELASTOON_API ElastoonResult elastoonShapeDestroy(ElastoonShape shape);
ELASTOON_API bool elastoonShapeIsValid(ElastoonShape shape);
ELASTOON_API ElastoonResult elastoonShapeInfo(ElastoonShape shape, ElastoonShapeInfo* out_info);
ELASTOON_API ElastoonResult elastoonShapeVertices(ElastoonShape shape, ElastoonVec3* out_vertices, size_t capacity,
                                                  size_t* out_count);
/** Its faces cut into triangles, counter-clockwise seen from outside: three indices of vertices each. Capacity and
   count are in indices. */
ELASTOON_API ElastoonResult elastoonShapeTriangles(ElastoonShape shape, uint32_t* out_indices, size_t capacity,
                                                   size_t* out_count);

/* ---- Worlds ---- */

/** Does part(part_context, begin, end) for parts of 0..count, in any order, on any threads, and returns when all are
    done. The results do not depend on how the range is cut. */
typedef void (*ElastoonRangeFunction)(void* part_context, size_t begin, size_t end);
typedef void (*ElastoonParallelFor)(void* context, size_t count, ElastoonRangeFunction part, void* part_context);

typedef struct ElastoonWorldDef {
    ElastoonVec3 gravity; /**< m/s^2, within +-1e6; 0, -9.81, 0 */
    ElastoonParallelFor parallel_for; /**< null: on the calling thread */
    void* parallel_context; /**< yours, handed to parallel_for */
} ElastoonWorldDef;

ELASTOON_API ElastoonWorldDef elastoonDefaultWorldDef(void);
ELASTOON_API ElastoonResult elastoonWorldCreate(const ElastoonWorldDef* def, ElastoonWorld* out_world);
/** With all that is in it. */
ELASTOON_API ElastoonResult elastoonWorldDestroy(ElastoonWorld world);
ELASTOON_API bool elastoonWorldIsValid(ElastoonWorld world);
/** Moves the world on by dt s, 0 to 1e6. */
ELASTOON_API ElastoonResult elastoonWorldStep(ElastoonWorld world, double dt);
/** Seconds since the world was made. */
ELASTOON_API ElastoonResult elastoonWorldTime(ElastoonWorld world, double* out_time);
ELASTOON_API ElastoonResult elastoonWorldGravity(ElastoonWorld world, ElastoonVec3* out_gravity);
/** Flights go on under the new gravity. */
ELASTOON_API ElastoonResult elastoonWorldSetGravity(ElastoonWorld world, ElastoonVec3 gravity);
/** Equal worlds have equal hashes, on every machine: docs/determinism.md. */
ELASTOON_API ElastoonResult elastoonWorldStateHash(ElastoonWorld world, uint64_t* out_hash);
/** In the order of their slots. */
ELASTOON_API ElastoonResult elastoonWorldBodies(ElastoonWorld world, ElastoonBody* out_bodies, size_t capacity,
                                                size_t* out_count);
ELASTOON_API ElastoonResult elastoonWorldObstacles(ElastoonWorld world, ElastoonObstacle* out_obstacles,
                                                   size_t capacity, size_t* out_count);

/* ---- Bulk: everything that a frame needs, in one call. One item for each slot of a body, also where the slot is free:
   body b's is item b.slot - 1, and a free slot's matrices are all zero (which draws nothing). ---- */

/** 12 floats a slot: the three columns of the linear part R S, then the position. Column vectors: x = M X + position.
 */
ELASTOON_API ElastoonResult elastoonWorldMatrices(ElastoonWorld world, float* out_matrices, size_t capacity,
                                                  size_t* out_count);
ELASTOON_API ElastoonResult elastoonWorldMatricesDouble(ElastoonWorld world, double* out_matrices, size_t capacity,
                                                        size_t* out_count);
/** 9 floats a slot: the columns of the linear part's inverse transpose, R S^-1. Normalise after multiplying. */
ELASTOON_API ElastoonResult elastoonWorldNormalMatrices(ElastoonWorld world, float* out_matrices, size_t capacity,
                                                        size_t* out_count);
ELASTOON_API ElastoonResult elastoonWorldNormalMatricesDouble(ElastoonWorld world, double* out_matrices,
                                                              size_t capacity, size_t* out_count);
/** As elastoonWorldMatrices, in memory of the world's own, which it fills where something changed since the last time.
    Valid until the next call on this world that changes it. */
ELASTOON_API ElastoonResult elastoonWorldMatricesView(ElastoonWorld world, const float** out_matrices,
                                                      size_t* out_count);
/** A free slot's pose is the one of a body that stands unstretched at the origin. */
ELASTOON_API ElastoonResult elastoonWorldPoses(ElastoonWorld world, ElastoonPose* out_poses, size_t capacity,
                                               size_t* out_count);

typedef enum ElastoonEventType {
    kElastoonImpact = 0, /**< a touch began an impact */
    kElastoonRelease, /**< an impact ended and the body flies */
    kElastoonRest, /**< an impact ended and the body is still */
    kElastoonWake, /**< a body at rest flies again */
    kElastoonSqueeze, /**< a body has no room left */
} ElastoonEventType;

/** What happened in the last step. The curve's fields (s_in to t_out) hold for impacts. */
typedef struct ElastoonEvent {
    double time;
    ElastoonBody body;
    ElastoonObstacle other;
    ElastoonVec3 point; /**< contact, world */
    ElastoonVec3 normal; /**< towards the body, world */
    double speed; /**< relative to the surface: before the impact, or after it for a release, m/s */
    double s_in, s_mid, s_out;
    double t_in, t_out;
    int32_t type; /**< ElastoonEventType */
} ElastoonEvent;

/** What happened in the last step, by time, then by body, in memory of the world's own. Valid until the next call on
   this world that changes it. */
ELASTOON_API ElastoonResult elastoonWorldEvents(ElastoonWorld world, const ElastoonEvent** out_events,
                                                size_t* out_count);
/** "impact", "release", ...; "" for a number that is no type. */
ELASTOON_API const char* elastoonEventName(int32_t type);

/** All that later steps read, as bytes; capacity and size are in bytes. docs/snapshot.md. Without the shapes, the
   program that restores it must have them. */
ELASTOON_API ElastoonResult elastoonWorldSnapshot(ElastoonWorld world, bool include_shapes, void* out_bytes,
                                                  size_t capacity, size_t* out_size);
/** Makes this world the one of the snapshot. Shapes are found by content among those of this world, those that have an
   id, and those in the bytes. Refused, with the world as it was: bytes that are damaged or of another version; and a
   world that is being recorded (elastoonRecordingRewind() takes both back). */
ELASTOON_API ElastoonResult elastoonWorldRestore(ElastoonWorld world, const void* bytes, size_t size);

/* ---- Timelines: all that the bodies of a world did, for any time, forwards and back ---- */

typedef struct ElastoonTimeline {
    uint32_t slot, generation;
} ElastoonTimeline;

typedef struct ElastoonTimelineInfo {
    double start, end; /**< world time, s */
    size_t capture_count; /**< steps that were captured */
} ElastoonTimelineInfo;

/** Takes what is in the world now; capture after each step. It keeps no hold of the world. */
ELASTOON_API ElastoonResult elastoonTimelineBegin(ElastoonWorld world, ElastoonTimeline* out_timeline);
/** Takes what the last step of the world did. */
ELASTOON_API ElastoonResult elastoonTimelineCapture(ElastoonTimeline timeline);
/** Forgets what came after that many captures: for a world that was restored to that step and goes another way from
    there. */
ELASTOON_API ElastoonResult elastoonTimelineCut(ElastoonTimeline timeline, size_t captures);
ELASTOON_API ElastoonResult elastoonTimelineDestroy(ElastoonTimeline timeline);
ELASTOON_API bool elastoonTimelineIsValid(ElastoonTimeline timeline);
ELASTOON_API ElastoonResult elastoonTimelineInfo(ElastoonTimeline timeline, ElastoonTimelineInfo* out_info);
/** As elastoonWorldMatrices, as it was at that time: zeros for bodies that came later. A body that was removed goes on
   as it was expected to until its slot is used again. */
ELASTOON_API ElastoonResult elastoonTimelineMatrices(ElastoonTimeline timeline, double time, float* out_matrices,
                                                     size_t capacity, size_t* out_count);
/** Poses and velocities of one body at the times; either array may be null. */
ELASTOON_API ElastoonResult elastoonTimelinePoses(ElastoonTimeline timeline, ElastoonBody body, const double* times,
                                                  size_t count, ElastoonPose* out_poses, ElastoonVec3* out_velocities);
/** All events, by step, in memory of the timeline's own. Valid until the next capture or cut. */
ELASTOON_API ElastoonResult elastoonTimelineEvents(ElastoonTimeline timeline, const ElastoonEvent** out_events,
                                                   size_t* out_count);

/* ---- Recordings: what was done to a world, to be done again to the bit. docs/snapshot.md ---- */

typedef struct ElastoonRecording {
    uint32_t slot, generation;
} ElastoonRecording;

typedef struct ElastoonRecordingInfo {
    size_t step_count;
    size_t input_count; /**< calls that changed the world, steps not counted */
    bool is_live; /**< it takes what is done to a world */
} ElastoonRecordingInfo;

/** Takes the world as it is, and from now on every call that changes it, with the number of steps before it, until the
    recording or the world is destroyed. A call on it is one on that world. Refused: a second one of the same world. */
ELASTOON_API ElastoonResult elastoonRecordingBegin(ElastoonWorld world, ElastoonRecording* out_recording);
/** From the bytes of elastoonRecordingBytes(). Refused: bytes that are damaged, of another version, or unsound. */
ELASTOON_API ElastoonResult elastoonRecordingRead(const void* bytes, size_t size, ElastoonRecording* out_recording);
ELASTOON_API ElastoonResult elastoonRecordingDestroy(ElastoonRecording recording);
ELASTOON_API bool elastoonRecordingIsValid(ElastoonRecording recording);
ELASTOON_API ElastoonResult elastoonRecordingInfo(ElastoonRecording recording, ElastoonRecordingInfo* out_info);
/** All of it, with the shapes; capacity and size are in bytes. */
ELASTOON_API ElastoonResult elastoonRecordingBytes(ElastoonRecording recording, void* out_bytes, size_t capacity,
                                                   size_t* out_size);
/** Makes the world the one that the recording began with, as elastoonWorldRestore() does: then replay. Refused: a world
    that is being recorded. */
ELASTOON_API ElastoonResult elastoonRecordingStart(ElastoonRecording recording, ElastoonWorld world);
/** Takes a world that is where the recorded one was before step `from` (0 to step_count) through its inputs and steps,
    up to step `to`, which is not made, nor its inputs. Inputs after the last step are made if `to` is greater than
    step_count: SIZE_MAX is good for all. Refused: a world that is being recorded; and at the first input that the
    world does not take as the recorded one did: elastoonLastError() tells which, and the world is where it came to. */
ELASTOON_API ElastoonResult elastoonRecordingReplay(ElastoonRecording recording, ElastoonWorld world, size_t from,
                                                    size_t to);
/** Takes the world that is being recorded back to a snapshot from before step `step` (0 to step_count) and its inputs,
    and forgets what was recorded since. Refused as elastoonWorldRestore(), and for a recording that is not live. */
ELASTOON_API ElastoonResult elastoonRecordingRewind(ElastoonRecording recording, size_t step, const void* bytes,
                                                    size_t size);

/* ---- Bodies ---- */

typedef struct ElastoonBodyDef {
    ElastoonShape shape; /**< required */
    ElastoonStyle style;
    ElastoonVec3 position; /**< of the centroid, m, within +-1e9 */
    ElastoonVec3 velocity; /**< m/s, within +-1e6 */
    ElastoonQuat rotation; /**< only its roll about the heading is kept */
    uint64_t user_data; /**< yours; not read */
} ElastoonBodyDef;

/** How a body would start inside an obstacle. */
typedef struct ElastoonOverlap {
    ElastoonObstacle obstacle; /**< null: it does not */
    double depth; /**< m */
    ElastoonVec3 normal; /**< way out, unit */
} ElastoonOverlap;

typedef enum ElastoonPhaseKind {
    kElastoonFlight = 0,
    kElastoonInImpact,
    kElastoonAtRest,
    kElastoonSlide,
} ElastoonPhaseKind;

typedef struct ElastoonPhaseInfo {
    int32_t kind; /**< ElastoonPhaseKind */
    double start; /**< world time, s */
    double end; /**< its own end, as far as it is known; infinity: none */
    ElastoonObstacle obstacle; /**< that an impact, rest or slide is against, or that a flight has just left */
} ElastoonPhaseInfo;

ELASTOON_API ElastoonBodyDef elastoonDefaultBodyDef(void);
/** Refused besides bad numbers: a start inside an obstacle, deeper than 1e-6 of the length. */
ELASTOON_API ElastoonResult elastoonBodyCreate(ElastoonWorld world, const ElastoonBodyDef* def, ElastoonBody* out_body);
ELASTOON_API ElastoonResult elastoonBodyDestroy(ElastoonBody body);
ELASTOON_API bool elastoonBodyIsValid(ElastoonBody body);
/** Where a body of this definition would start inside an obstacle: the deepest such place. */
ELASTOON_API ElastoonResult elastoonWorldOverlap(ElastoonWorld world, const ElastoonBodyDef* def,
                                                 ElastoonOverlap* out_overlap);
ELASTOON_API ElastoonResult elastoonBodyPose(ElastoonBody body, ElastoonPose* out_pose);
ELASTOON_API ElastoonResult elastoonBodyVelocity(ElastoonBody body, ElastoonVec3* out_velocity);
ELASTOON_API ElastoonResult elastoonBodyPhase(ElastoonBody body, ElastoonPhaseInfo* out_phase);
ELASTOON_API ElastoonResult elastoonBodyStyle(ElastoonBody body, ElastoonStyle* out_style);
ELASTOON_API ElastoonResult elastoonBodyUserData(ElastoonBody body, uint64_t* out_user_data);
/** A new id of the body's shape, yours to destroy. */
ELASTOON_API ElastoonResult elastoonBodyShape(ElastoonBody body, ElastoonShape* out_shape);
/** Puts the body there and lets it fly with its present velocity. Refused inside an obstacle. */
ELASTOON_API ElastoonResult elastoonBodySetPosition(ElastoonBody body, ElastoonVec3 position);
/** The body flies with this velocity from now on. */
ELASTOON_API ElastoonResult elastoonBodySetVelocity(ElastoonBody body, ElastoonVec3 velocity);
/** The impact that the body is in ends with this velocity (world), for a game's paddle; it turns towards it about the
 * contact. Refused in no impact, and where the velocity does not part from the surface. */
ELASTOON_API ElastoonResult elastoonBodySteerImpact(ElastoonBody body, ElastoonVec3 velocity);
/** Holds from the body's next phase on; a flight takes it over at once. */
ELASTOON_API ElastoonResult elastoonBodySetStyle(ElastoonBody body, const ElastoonStyle* style);
/** The body's poses `delays[i]` s from now (0 to 1e6), as far as nothing is changed meanwhile. The world stays as it
 * is. */
ELASTOON_API ElastoonResult elastoonBodyPredictPoses(ElastoonBody body, const double* delays, size_t count,
                                                     ElastoonPose* out_poses);
/** What will happen to it within `horizon` s (0 to 1e6), likewise. */
ELASTOON_API ElastoonResult elastoonBodyPredictEvents(ElastoonBody body, double horizon, ElastoonEvent* out_events,
                                                      size_t capacity, size_t* out_count);

/* ---- Obstacles: planes and convex solids that do not give way ---- */

typedef struct ElastoonPathKey {
    double time; /**< s after the obstacle was added; ascending, > 0 */
    ElastoonVec3 position;
    ElastoonQuat rotation;
} ElastoonPathKey;

typedef struct ElastoonObstacleDef {
    ElastoonShape shape; /**< null: the half space below the plane through `position`, across `normal` */
    ElastoonVec3 normal; /**< of a plane, any length but zero, in the obstacle's frame; 0 1 0 */
    ElastoonVec3 position; /**< m, within +-1e9 */
    ElastoonQuat rotation;
    ElastoonVec3 velocity; /**< m/s, within +-1e6 */
    ElastoonVec3 angular_velocity; /**< world axes, rad/s, within +-1e4 */
    const ElastoonPathKey* path; /**< copied; null: it goes on with its velocities */
    size_t path_count;
    bool path_repeats; /**< at the last key it jumps back to where it was added */
    uint64_t user_data; /**< yours; not read; 0 */
} ElastoonObstacleDef;

/** Where an obstacle is and how it moves, now. */
typedef struct ElastoonObstacleFrame {
    ElastoonVec3 position;
    ElastoonQuat rotation;
    ElastoonVec3 velocity;
    ElastoonVec3 angular_velocity;
} ElastoonObstacleFrame;

ELASTOON_API ElastoonObstacleDef elastoonDefaultObstacleDef(void);
/** The plane { x : x . normal = offset }, solid on the side that the normal points away from. */
ELASTOON_API ElastoonObstacleDef elastoonPlaneDef(ElastoonVec3 normal, double offset);
ELASTOON_API ElastoonResult elastoonObstacleCreate(ElastoonWorld world, const ElastoonObstacleDef* def,
                                                   ElastoonObstacle* out_obstacle);
/** Bodies that rest on it or are in an impact with it fly on. */
ELASTOON_API ElastoonResult elastoonObstacleDestroy(ElastoonObstacle obstacle);
ELASTOON_API bool elastoonObstacleIsValid(ElastoonObstacle obstacle);
ELASTOON_API ElastoonResult elastoonObstacleFrame(ElastoonObstacle obstacle, ElastoonObstacleFrame* out_frame);
/** A new id of its shape, yours to destroy; the null id for a plane. */
ELASTOON_API ElastoonResult elastoonObstacleShape(ElastoonObstacle obstacle, ElastoonShape* out_shape);
/** Of a plane, unit, in its frame. */
ELASTOON_API ElastoonResult elastoonObstaclePlaneNormal(ElastoonObstacle obstacle, ElastoonVec3* out_normal);
ELASTOON_API ElastoonResult elastoonObstacleUserData(ElastoonObstacle obstacle, uint64_t* out_user_data);
/** It goes on from where it is with these velocities, and leaves its path; bodies on it go along. */
ELASTOON_API ElastoonResult elastoonObstacleSetMotion(ElastoonObstacle obstacle, ElastoonVec3 velocity,
                                                      ElastoonVec3 angular_velocity);
/** It is there from now on and stands still. What rested on it stays behind. */
ELASTOON_API ElastoonResult elastoonObstacleSetPose(ElastoonObstacle obstacle, ElastoonVec3 position,
                                                    ElastoonQuat rotation);
/** It goes there within `duration` s (> 0) and stops. */
ELASTOON_API ElastoonResult elastoonObstacleMove(ElastoonObstacle obstacle, ElastoonVec3 position,
                                                 ElastoonQuat rotation, double duration);

/* ---- Scenes: the same files that the program reads, docs/scene.md. (Not in a library built with ELASTOON_SCENE off.)
   ---- */

typedef struct ElastoonSceneInfo {
    const char* name; /**< texts live as long as the scene */
    ElastoonVec3 gravity;
    double duration; /**< s */
    size_t shape_count, body_count, obstacle_count;
    bool has_camera;
    ElastoonVec3 camera_eye, camera_target;
    double camera_fov_degrees; /**< vertical */
} ElastoonSceneInfo;

typedef struct ElastoonSceneBody {
    const char* name;
    size_t shape; /**< index among the scene's shapes */
    ElastoonBodyDef def;
    ElastoonVec3 color; /**< sRGB, 0 to 1 */
} ElastoonSceneBody;

typedef struct ElastoonSceneObstacle {
    const char* name;
    bool has_shape; /**< else it is a plane */
    size_t shape; /**< index among the scene's shapes */
    ElastoonObstacleDef def; /**< its path lives as long as the scene */
    ElastoonVec3 color;
} ElastoonSceneObstacle;

/** Reads a scene's text, `length` bytes. `file` names it in messages, and may be null. Mesh files are not read. */
ELASTOON_API ElastoonResult elastoonSceneParse(const char* text, size_t length, const char* file,
                                               ElastoonScene* out_scene);
ELASTOON_API ElastoonResult elastoonSceneDestroy(ElastoonScene scene);
ELASTOON_API bool elastoonSceneIsValid(ElastoonScene scene);
ELASTOON_API ElastoonResult elastoonSceneInfo(ElastoonScene scene, ElastoonSceneInfo* out_info);
/** The shape's id belongs to the scene: it is valid until the scene is destroyed. `out_name` may be null. */
ELASTOON_API ElastoonResult elastoonSceneShape(ElastoonScene scene, size_t index, const char** out_name,
                                               ElastoonShape* out_shape);
ELASTOON_API ElastoonResult elastoonSceneBody(ElastoonScene scene, size_t index, ElastoonSceneBody* out_body);
ELASTOON_API ElastoonResult elastoonSceneObstacle(ElastoonScene scene, size_t index,
                                                  ElastoonSceneObstacle* out_obstacle);
/** Where that obstacle is `time` s after the scene was staged, if nobody changes it. */
ELASTOON_API ElastoonResult elastoonSceneObstacleFrame(ElastoonScene scene, size_t index, double time,
                                                       ElastoonObstacleFrame* out_frame);
/** A new world with all of the scene: its bodies and obstacles have the slots 1, 2, ... in the scene's order. */
ELASTOON_API ElastoonResult elastoonSceneStage(ElastoonScene scene, ElastoonWorld* out_world);

#ifdef __cplusplus
}
#endif

#endif
