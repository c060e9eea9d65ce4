// Numbers as messages write them.
#include "check_input.h"
#include "test_support.h"

#include <cmath>
#include <cstdio>
#include <limits>

namespace elastoon {
namespace {

std::string printed(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

TEST(ShortNumber, IsAsPrintfWritesIt) {
    for (const double value : {0.0,
                               -0.0,
                               1.0,
                               -1.0,
                               0.1,
                               10.0,
                               100000.0,
                               999999.0,
                               1e6,
                               999999.5,
                               1e-4,
                               1e-5,
                               9.999995e-5,
                               1.5,
                               0.02,
                               1e9,
                               1e300,
                               5e-324,
                               1.7976931348623157e308,
                               2.5e-7,
                               12345678.0}) {
        EXPECT_EQ(shortNumber(value), printed(value));
    }
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(shortNumber(infinity), "inf");
    EXPECT_EQ(shortNumber(-infinity), "-inf");
    EXPECT_EQ(shortNumber(std::numeric_limits<double>::quiet_NaN()), "nan");
}

TEST(ShortNumber, IsAsPrintfWritesRandomOnes) {
    Random random(7);
    for (int i = 0; i < 100000; ++i) {
        const double value = random.uniform(-1.0, 1.0) * std::pow(10.0, random.uniform(-20.0, 20.0));
        EXPECT_EQ(shortNumber(value), printed(value));
    }
}

} // namespace
} // namespace elastoon
