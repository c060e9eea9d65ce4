// Room for the small records that come and go with each bounce: quicker than the system's, and in huge pages, where a
// million of them are found without looking up as many pages.
#pragma once

#include "elastoon/export.h"

#include <cstddef>

namespace elastoon ELASTOON_API {

/// Room for one record of `bytes` bytes, aligned for any type that asks for no more than alignof(std::max_align_t).
/// Throws std::bad_alloc where there is none. Room that has come back is kept for the next records, not for other uses.
/// Any thread may call it, and give back what another one took.
[[nodiscard]] void* takeRecordRoom(std::size_t bytes);
/// Gives back what takeRecordRoom(bytes) gave; null does nothing.
void giveRecordRoom(void* room, std::size_t bytes) noexcept;

/// The allocator of lists of few records.
template <class T>
class RecordAllocator {
public:
    using value_type = T;

    RecordAllocator() = default;
    template <class Other>
    RecordAllocator(const RecordAllocator<Other>&) {}

    [[nodiscard]] T* allocate(std::size_t count) {
        static_assert(alignof(T) <= alignof(std::max_align_t));
        return static_cast<T*>(takeRecordRoom(count * sizeof(T)));
    }
    void deallocate(T* room, std::size_t count) noexcept { giveRecordRoom(room, count * sizeof(T)); }

    bool operator==(const RecordAllocator&) const = default;
};

} // namespace elastoon ELASTOON_API
