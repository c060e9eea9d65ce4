// A phase's record: what its copies share, and what they do not. See elastoon/phase.h.
#include "elastoon/phase.h"

#include <gtest/gtest.h>

#include <utility>

namespace elastoon {
namespace {

Phase flightAt(double x) {
    Flight flight;
    flight.position.x = x;
    Phase phase;
    phase.motion = flight;
    return phase;
}

TEST(Boxed, CopiesShareUntilOneIsChanged) {
    const Phase first = flightAt(1.0);
    Phase second = first;
    EXPECT_EQ(second.as<Flight>(), first.as<Flight>());
    second.edit<Flight>().position.x = 2.0;
    EXPECT_EQ(first.get<Flight>().position.x, 1.0);
    EXPECT_EQ(second.get<Flight>().position.x, 2.0);
    // Alone, it is changed where it is.
    const Flight* const own = second.as<Flight>();
    second.edit<Flight>().position.x = 3.0;
    EXPECT_EQ(second.as<Flight>(), own);
}

TEST(Boxed, WhatIsUsualTakesNoRoomUntilItIsChanged) {
    Boxed<Ease> ease;
    const Boxed<Ease> copy = ease;
    EXPECT_TRUE(ease.isUsual());
    EXPECT_EQ(*ease, Ease{});
    ease.edit().span = 1.0;
    EXPECT_FALSE(ease.isUsual());
    EXPECT_EQ(ease->span, 1.0);
    EXPECT_EQ(copy->span, 0.0);
}

TEST(Boxed, OutlivesTheCopyThatItCameFrom) {
    Phase kept;
    {
        const Phase first = flightAt(4.0);
        kept = first;
    }
    EXPECT_EQ(kept.get<Flight>().position.x, 4.0);
    Phase moved = std::move(kept);
    EXPECT_EQ(moved.get<Flight>().position.x, 4.0);
    moved = flightAt(5.0);
    EXPECT_EQ(moved.get<Flight>().position.x, 5.0);
}

} // namespace
} // namespace elastoon
