// Arrays in huge pages hold what other arrays hold, small and large, while they grow and shrink.
#include "large_array.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace elastoon {
namespace {

struct alignas(64) Line {
    std::uint64_t number = 0;
};

/// Grows through the size from which on huge pages are asked for.
template <class T, class Number>
void growsAndShrinks(std::size_t count, Number&& numberOf) {
    LargeArray<T> list;
    for (std::size_t i = 0; i < count; ++i) {
        list.push_back(T{i});
        ASSERT_EQ(reinterpret_cast<std::uintptr_t>(list.data()) % alignof(T), 0U);
    }
    ASSERT_GE(list.capacity() * sizeof(T), std::size_t{4} << 20U);
    LargeArray<T> copy = list;
    list.resize(10);
    list.shrink_to_fit();
    for (std::size_t i = 0; i < count; ++i) {
        ASSERT_EQ(numberOf(copy[i]), i);
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
        ASSERT_EQ(numberOf(list[i]), i);
    }
}

TEST(LargeArray, HoldsNumbersSmallAndLarge) {
    growsAndShrinks<std::uint64_t>(700000, [](std::uint64_t number) { return number; });
}

TEST(LargeArray, HoldsWhatWantsWholeLines) {
    growsAndShrinks<Line>(80000, [](const Line& line) { return line.number; });
}

#if defined(__linux__)
TEST(LargeArray, LargeOnesBeginWithAHugePage) {
    const LargeArray<char> large(std::size_t{5} << 20U);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(large.data()) % (std::size_t{2} << 20U), 0U);
}
#endif

} // namespace
} // namespace elastoon
