// Arrays of something for each body or obstacle, in huge pages as soon as they are large.
#pragma once

#include <vector>

#if defined(__linux__)
#include "huge_pages.h"

#include <cstddef>
#include <new>
#endif

namespace elastoon {

#if defined(__linux__)
/// The system's allocator; from a few megabytes on it asks for huge pages.
template <class T>
class LargePages {
public:
    using value_type = T;

    LargePages() = default;
    template <class Other>
    LargePages(const LargePages<Other>&) {}

    [[nodiscard]] T* allocate(std::size_t count) {
        const std::size_t bytes = count * sizeof(T);
        void* room = ::operator new(bytes, alignmentOf(bytes));
        if (isLarge(bytes)) {
            askForHugePages(room, bytes);
        }
        return static_cast<T*>(room);
    }
    void deallocate(T* room, std::size_t count) { ::operator delete(room, alignmentOf(count * sizeof(T))); }

    bool operator==(const LargePages&) const = default;

private:
    [[nodiscard]] static bool isLarge(std::size_t bytes) { return bytes >= 2 * kHugePage; }
    [[nodiscard]] static std::align_val_t alignmentOf(std::size_t bytes) {
        return std::align_val_t{isLarge(bytes) ? kHugePage : alignof(T)};
    }
};

template <class T>
using LargeArray = std::vector<T, LargePages<T>>;
#else
template <class T>
using LargeArray = std::vector<T>;
#endif

} // namespace elastoon
