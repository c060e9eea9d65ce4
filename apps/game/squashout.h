/* Squashout's C interface, for the page: games by pointer, what happened and what is drawn as lists of numbers. Texts
   and lists belong to the library and hold until the next call that gives one of the same game. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct Squashout Squashout;

/** Takes the levels of a level file's text, for games that are made from now on. Null, or what is wrong with it. */
const char* squashoutLoadLevels(const char* text, size_t length);
uint32_t squashoutLevelCount(void);
/** Null beyond the last. */
const char* squashoutLevelName(uint32_t level);

/** Null without levels. The bot has the same seed; `skill` 0..1 is its. Levels count from 0. */
Squashout* squashoutCreate(uint32_t seed, int gravity, uint32_t first_level, double skill);
void squashoutDestroy(Squashout* game);

/** One step of 1/120 s. `axis` -127..127; with has_target, `target` -32767..32767 from wall to wall counts instead. Out
 * of range is cut. */
void squashoutStep(Squashout* game, int launch, int has_target, int axis, int target);
/** The same by the bot. */
void squashoutStepBot(Squashout* game);

/** kSquashoutNumbers doubles: stage, score, lives, level, combo, balls, blocks left, steps, paddle x, paddle half
 * width, its velocity, seconds that it stays wide, fastest ball's speed, 1 with gravity, escapes, lowest ball's x. */
const double* squashoutNumbers(Squashout* game);
enum { kSquashoutNumbers = 16 };

/** What happened in the last step: kSquashoutEventFloats each: kind, block, id, x, y, normal x, normal y, speed, value.
 */
const float* squashoutEvents(Squashout* game, uint32_t* out_count);
enum { kSquashoutEventFloats = 9 };

/** What is drawn, `share` 0..1 of the way from the step before to this one: kSquashoutDrawnFloats each: what, block,
 * id, extra, three columns of the linear part, position. */
const float* squashoutDrawn(Squashout* game, double share, uint32_t* out_count);
enum { kSquashoutDrawnFloats = 16 };

/** The paddle's outline of this half width: x and y of each point, about its foot's middle. */
const float* squashoutPaddleOutline(Squashout* game, double half_width, uint32_t* out_count);
/** Sizes, m: the field's half width, ceiling, ball radius, block width, height, depth, round
 * block's radius. */
const double* squashoutSizes(void);

/** 16 hexadecimal digits. */
const char* squashoutHash(Squashout* game);
/** The play so far as JSON text, for `elastoon-game replay`. */
const char* squashoutRecording(Squashout* game);
/** A game that has been taken through the recorded play; null where that is no play of these levels or its hash is
 * another: then squashoutError() says why. */
Squashout* squashoutReplay(const char* text, size_t length);
const char* squashoutError(void);

#ifdef __cplusplus
}
#endif
