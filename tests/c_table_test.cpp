// The slots behind the ids of the C interface: generations, growth, and several threads at a time.
#include "c_table.h"

#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <thread>
#include <vector>

namespace elastoon::c_interface {

namespace {

using Numbers = Table<int>;

TEST(CTable, FindsWhatIsThereAndNothingElse) {
    Numbers table;
    const Numbers::Key key = table.add(std::make_unique<int>(7));
    ASSERT_NE(table.find(key), nullptr);
    EXPECT_EQ(*table.find(key), 7);
    EXPECT_EQ(table.find({}), nullptr);
    EXPECT_EQ(table.find({key.slot, key.generation + 1}), nullptr);
    EXPECT_EQ(table.find({key.slot, key.generation + 2}), nullptr);
    EXPECT_EQ(table.find({key.slot + 1, key.generation}), nullptr);
    EXPECT_EQ(table.find({key.slot + 100000, key.generation}), nullptr);
    EXPECT_EQ(table.find({0xffffffffU, key.generation}), nullptr);
    EXPECT_EQ(*table.remove(key), 7);
    EXPECT_EQ(table.find(key), nullptr);
    EXPECT_EQ(table.remove(key), nullptr);
    const Numbers::Key next = table.add(std::make_unique<int>(8));
    EXPECT_EQ(next.slot, key.slot);
    EXPECT_NE(next.generation, key.generation);
    EXPECT_EQ(table.find(key), nullptr);
}

TEST(CTable, GrowsAndKeepsWhatItHas) {
    Numbers table;
    std::vector<Numbers::Key> keys;
    std::set<std::uint32_t> slots;
    for (int i = 0; i < 2000; ++i) {
        keys.push_back(table.add(std::make_unique<int>(i)));
        slots.insert(keys.back().slot);
    }
    EXPECT_EQ(slots.size(), keys.size());
    int sum = 0;
    table.forEach([&](const int& number) { sum += number; });
    EXPECT_EQ(sum, 1999 * 1000);
    for (int i = 0; i < 2000; ++i) {
        ASSERT_EQ(*table.find(keys[static_cast<std::size_t>(i)]), i);
    }
}

/// Each thread adds, finds and removes its own, while the table grows: the thread sanitizer's business too.
TEST(CTable, ServesSeveralThreads) {
    Numbers table;
    std::atomic<int> wrong{0};
    std::vector<std::thread> threads;
    for (int thread = 0; thread < 4; ++thread) {
        threads.emplace_back([&table, &wrong, thread] {
            std::vector<Numbers::Key> keys;
            for (int i = 0; i < 1000; ++i) {
                keys.push_back(table.add(std::make_unique<int>(thread)));
                const int* found = table.find(keys.back());
                wrong += found == nullptr || *found != thread ? 1 : 0;
                if (i % 3 == 0) {
                    wrong += table.remove(keys.front()) == nullptr ? 1 : 0;
                    keys.erase(keys.begin());
                }
            }
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    int left = 0;
    table.forEach([&](const int&) { ++left; });
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(left, 4 * (1000 - 334));
}

} // namespace

} // namespace elastoon::c_interface
