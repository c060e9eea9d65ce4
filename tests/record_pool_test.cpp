// Rooms for records never overlap, whatever is taken, given back, and by which thread.
#include "elastoon/record_pool.h"

#include "test_support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <set>
#include <thread>
#include <vector>

namespace elastoon {
namespace {

/// A room, filled with what nobody else writes.
struct Room {
    unsigned char* begin;
    std::size_t bytes;
    unsigned char mark;
};

Room takeRoom(std::size_t bytes, unsigned char mark) {
    auto* begin = static_cast<unsigned char*>(takeRecordRoom(bytes));
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(begin) % alignof(std::max_align_t), 0U);
    std::memset(begin, mark, bytes);
    return {begin, bytes, mark};
}

void giveRoom(const Room& room) {
    EXPECT_TRUE(std::all_of(room.begin, room.begin + room.bytes, [&](unsigned char c) { return c == room.mark; }))
        << room.bytes << " bytes";
    giveRecordRoom(room.begin, room.bytes);
}

/// Takes and gives at random; what is left is given back by whoever has it in the end.
void useRooms(std::uint64_t seed, std::vector<Room>& rooms) {
    Random random(seed);
    for (int i = 0; i < 20000; ++i) {
        const bool takes = rooms.empty() || random.uniform(0.0, 1.0) < (i / 4000 % 2 == 0 ? 0.7 : 0.3);
        if (takes) {
            const auto bytes = std::size_t{1} + static_cast<std::size_t>(random.below(800));
            rooms.push_back(takeRoom(bytes, static_cast<unsigned char>(random.below(256))));
        } else {
            std::swap(rooms[static_cast<std::size_t>(random.below(static_cast<int>(rooms.size())))], rooms.back());
            giveRoom(rooms.back());
            rooms.pop_back();
        }
    }
}

TEST(RecordPool, RoomsKeepWhatIsInThem) {
    std::vector<Room> rooms;
    useRooms(7, rooms);
    std::for_each(rooms.begin(), rooms.end(), giveRoom);
}

TEST(RecordPool, RoomsGoFromThreadToThread) {
    std::vector<std::vector<Room>> rooms(4);
    for (int turn = 0; turn < 3; ++turn) {
        std::vector<std::thread> threads;
        for (std::size_t k = 0; k < rooms.size(); ++k) {
            threads.emplace_back([&rooms, k, turn] { useRooms(10 * k + static_cast<std::size_t>(turn), rooms[k]); });
        }
        for (std::thread& thread : threads) {
            thread.join();
        }
        std::rotate(rooms.begin(), rooms.begin() + 1, rooms.end());
    }
    for (const std::vector<Room>& left : rooms) {
        std::for_each(left.begin(), left.end(), giveRoom);
    }
}

TEST(RecordPool, RoomsAreUsedAgain) {
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
    GTEST_SKIP() << "each record is the system's own";
#endif
#endif
    // Of fewer than go between threads at once, too.
    for (const int count : {100, 10}) {
        std::set<void*> places;
        for (int turn = 0; turn < 200; ++turn) {
            std::vector<Room> rooms;
            for (int i = 0; i < count; ++i) {
                rooms.push_back(takeRoom(208, 1));
                places.insert(rooms.back().begin);
            }
            std::thread([&rooms] { std::for_each(rooms.begin(), rooms.end(), giveRoom); }).join();
        }
        EXPECT_LT(places.size(), 400U) << count << " at once";
    }
}

TEST(RecordPool, NoBytesAndNoRoomAreNothingSpecial) {
    giveRecordRoom(nullptr, 0);
    giveRecordRoom(nullptr, 100);
    giveRecordRoom(takeRecordRoom(0), 0);
}

} // namespace
} // namespace elastoon
