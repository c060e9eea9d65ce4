// See record_pool.h. Each thread has a list of free rooms for each size; whole batches of them go from thread to thread
// through a shared one.
#include "elastoon/record_pool.h"

#include <new>

// Without threads there is little to gain; and a sanitizer is to see each record by itself.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer)
#define ELASTOON_PLAIN_RECORDS
#endif
#endif
#if defined(__wasm__) || defined(__SANITIZE_ADDRESS__)
#define ELASTOON_PLAIN_RECORDS
#endif

#if defined(ELASTOON_PLAIN_RECORDS)

namespace elastoon {

void* takeRecordRoom(std::size_t bytes) {
    return ::operator new(bytes);
}

void giveRecordRoom(void* room, std::size_t) noexcept {
    ::operator delete(room);
}

} // namespace elastoon

#else

#include "huge_pages.h"
#include "lock.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace elastoon {

namespace {

constexpr std::size_t kUnit = 32; ///< sizes are multiples of it, bytes
constexpr std::size_t kLargest = 640; ///< bytes; what is larger is rare, and the system's
constexpr std::size_t kSizes = kLargest / kUnit;
constexpr std::uint32_t kBatch = 32; ///< rooms that go between threads at once

/// What lies in a room that is free.
struct Free {
    Free* next;
    Free* next_batch; ///< of the first of a batch among the shared ones
};

struct List {
    Free* first = nullptr;
    std::uint32_t count = 0;
};

/// The rooms of all threads that are no thread's own, and the piece of memory that new ones are cut from. Nothing of it
/// is ever taken down: records may be given back while the program ends.
struct Shared {
    Mutex mutex;
    std::array<Free*, kSizes> batches{};
    std::array<List, kSizes> begun{}; ///< single ones, until they are a batch
    char* piece = nullptr;
    std::size_t left = 0; ///< bytes of the piece
    std::size_t next_piece = std::size_t{32} << 10U; ///< bytes; twice as many each time, up to a huge page

    List take(std::size_t size);
    void give(Free* batch, std::size_t size);
    void giveOne(Free* room, std::size_t size);

private:
    List cut(std::size_t bytes);
};

constinit Shared shared;

/// A batch, or what is left of the piece.
List Shared::cut(std::size_t bytes) {
    if (left < bytes) {
        piece = static_cast<char*>(::operator new(next_piece, std::align_val_t{next_piece}));
        left = next_piece;
        askForHugePages(piece, left);
        next_piece = std::min(2 * next_piece, kHugePage);
    }
    List list;
    while (list.count < kBatch && left >= bytes) {
        list.first = new (piece) Free{list.first, nullptr};
        ++list.count;
        piece += bytes;
        left -= bytes;
    }
    return list;
}

List Shared::take(std::size_t size) {
    const Lock lock(mutex);
    if (Free* batch = batches[size]) {
        batches[size] = batch->next_batch;
        return {batch, kBatch};
    }
    if (begun[size].count != 0) {
        return std::exchange(begun[size], List{});
    }
    return cut((size + 1) * kUnit);
}

void Shared::give(Free* batch, std::size_t size) {
    const Lock lock(mutex);
    batch->next_batch = batches[size];
    batches[size] = batch;
}

void Shared::giveOne(Free* room, std::size_t size) {
    const Lock lock(mutex);
    List& list = begun[size];
    room->next = list.first;
    list.first = room;
    if (++list.count == kBatch) {
        list.first->next_batch = batches[size];
        batches[size] = list.first;
        list = {};
    }
}

/// Of one thread.
struct Own {
    std::array<List, kSizes> using_now; ///< up to a batch
    std::array<List, kSizes> spare; ///< likewise; so who takes and gives by turns does not go to the shared ones
    bool awaits_end = false; ///< AtEnd is made
    bool at_end = false; ///< the thread ends: what comes now is shared at once
};

constinit thread_local Own own{};

/// Its end is the thread's.
struct AtEnd {
    ~AtEnd() {
        own.at_end = true;
        for (std::size_t size = 0; size < kSizes; ++size) {
            for (List* list : {&own.using_now[size], &own.spare[size]}) {
                while (Free* room = list->first) {
                    list->first = room->next;
                    shared.giveOne(room, size);
                }
                *list = {};
            }
        }
    }
    void await() {}
};

thread_local AtEnd at_end;

/// To be called before a list that was empty is not.
void awaitEnd() {
    if (!own.awaits_end) {
        own.awaits_end = true;
        at_end.await();
    }
}

void refill(std::size_t size) {
    List& list = own.using_now[size];
    if (own.spare[size].count != 0) {
        std::swap(list, own.spare[size]);
        return;
    }
    awaitEnd();
    list = shared.take(size);
}

/// The list is a batch.
void makeRoom(std::size_t size) {
    List& spare = own.spare[size];
    if (spare.count == kBatch) {
        shared.give(spare.first, size);
        spare = {};
    }
    std::swap(spare, own.using_now[size]);
}

} // namespace

void* takeRecordRoom(std::size_t bytes) {
    if (bytes > kLargest || bytes == 0) {
        return ::operator new(bytes);
    }
    const std::size_t size = (bytes - 1) / kUnit;
    if (own.at_end) {
        return ::operator new((size + 1) * kUnit);
    }
    List& list = own.using_now[size];
    if (list.count == 0) {
        refill(size);
    }
    Free* room = list.first;
    list.first = room->next;
    --list.count;
    return room;
}

void giveRecordRoom(void* room, std::size_t bytes) noexcept {
    if (bytes > kLargest || bytes == 0 || room == nullptr) {
        ::operator delete(room);
        return;
    }
    const std::size_t size = (bytes - 1) / kUnit;
    Free* free = new (room) Free{nullptr, nullptr};
    if (own.at_end) {
        shared.giveOne(free, size);
        return;
    }
    List& list = own.using_now[size];
    if (list.count == kBatch) {
        makeRoom(size);
    }
    awaitEnd();
    free->next = list.first;
    list.first = free;
    ++list.count;
}

} // namespace elastoon

#endif
