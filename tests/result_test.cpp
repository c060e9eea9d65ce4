// Results: values, errors, and what happens to those who do not look.
#include "elastoon/result.h"

#include "test_support.h"

#include <memory>

namespace elastoon {
namespace {

TEST(Result, HoldsAValueOrAnError) {
    const Result<int> good = 7;
    EXPECT_TRUE(good.ok());
    EXPECT_EQ(good.value(), 7);
    const Result<int> bad = Error{"too long", "name"};
    EXPECT_FALSE(bad);
    EXPECT_EQ(bad.error().text(), "name: too long");
    EXPECT_EQ((Error{"alone", ""}.text()), "alone");
    EXPECT_EQ(*Result<std::unique_ptr<int>>(std::make_unique<int>(3)).value(), 3);
    EXPECT_TRUE(success().ok());
}

TEST(ResultDeathTest, AValueThatIsNotThereTellsTheError) {
    const Result<int> bad = Error{"too long", "name"};
    EXPECT_DEATH((void)bad.value(), "name: too long");
}

} // namespace
} // namespace elastoon
