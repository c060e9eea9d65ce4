// Squashout's field and feel: sizes, speeds and styles, in one place. Lengths in m, times in s, y up, the field about x
// = 0.
#pragma once

#include "elastoon/style.h"

namespace squashout {

inline constexpr double kStep = 1.0 / 120.0; ///< of the rules; views draw in between

inline constexpr double kHalfWidth = 5.5;
inline constexpr double kCeiling = 16.0;

inline constexpr double kBallRadius = 0.32;
/// A ball whose centre is below is lost: it is beside the paddle's end, where that would press it to a wall, not lift
/// it.
inline constexpr double kLostBelow = 1.08;

inline constexpr double kPaddleFoot = 0.9;
inline constexpr double kPaddleHeight = 0.42;
inline constexpr double kPaddleDome = 0.1; ///< its top's middle over its rim
inline constexpr double kPaddleHalfWidth = 1.15;
inline constexpr double kWidePaddle = 1.55; ///< times the width
inline constexpr double kWideFor = 18.0;
inline constexpr double kPaddleMostSpeed = 36.0;
inline constexpr double kPaddleKeySpeed = 15.0;
inline constexpr double kPaddleKeyPush = 150.0; ///< m/s^2, of keys and stick
inline constexpr double kMostLean = 0.17; ///< rad, at full speed
inline constexpr double kSteepestAim = 1.06; ///< rad from straight up, at the paddle's ends

inline constexpr double kFlattestWay = 0.30; ///< rad from level: a flatter way takes too long
inline constexpr double kSpeedUp = 1.015; ///< at each touch of the paddle
inline constexpr double kMostSpeedUp = 1.35;
inline constexpr double kJellySpeed = 1.2; ///< what a jelly throws back is faster, until the next touch

inline constexpr int kColumns = 10;
inline constexpr int kMostRows = 18;
inline constexpr double kColumnPitch = 1.08;
inline constexpr double kRowPitch = 0.64;
inline constexpr double kTopRow = 15.2; ///< y of the first row's middle
inline constexpr double kBlockWidth = 0.98;
inline constexpr double kBlockHeight = 0.52;
inline constexpr double kBlockDepth = 0.9;
inline constexpr double kRoundBlock = 0.28; ///< radius of bombs and of blocks with a ball in them
inline constexpr double kBlast = 1.75; ///< between middles

inline constexpr int kLives = 3;
inline constexpr int kMostLives = 5;
inline constexpr int kMostBalls = 6;
inline constexpr int kMostCombo = 8;
inline constexpr int kIdleImpacts = 14; ///< without a block or the paddle: the ball goes round in circles
inline constexpr double kHelpAfter = 20.0; ///< without a block: balls are bent towards what is left
inline constexpr double kHelpBend = 0.12; ///< rad, at most
inline constexpr double kCelebration = 2.0; ///< between levels
inline constexpr double kLaunchesItself = 30.0; ///< a ball on the paddle

/// Snappy, and plain to see: a third longer at speed, half as high in a hit, about five frames in contact.
inline elastoon::Style ballStyle() {
    elastoon::Style style;
    style.restitution = 1.0;
    style.max_stretch = 1.5;
    style.min_squash = 0.35;
    style.stretch_rate = 0.2;
    style.squash_rate = 2.2;
    style.rest_speed = 0.0;
    style.friction = 0.0;
    return style;
}

} // namespace squashout
