// Arrays of something for each body or obstacle: of a million they are read here and there, and with small pages the
// processor would look up where a page is about as often as what is in it.
#pragma once

#include <vector>

#if defined(__linux__)
#include <sys/mman.h>

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
            // It may refuse; then the pages are small.
            (void)madvise(room, bytes - bytes % kPage, MADV_HUGEPAGE);
        }
        return static_cast<T*>(room);
    }
    void deallocate(T* room, std::size_t count) { ::operator delete(room, alignmentOf(count * sizeof(T))); }

    bool operator==(const LargePages&) const = default;

private:
    static constexpr std::size_t kPage = std::size_t{2} << 20U;
    [[nodiscard]] static bool isLarge(std::size_t bytes) { return bytes >= 2 * kPage; }
    [[nodiscard]] static std::align_val_t alignmentOf(std::size_t bytes) {
        return std::align_val_t{isLarge(bytes) ? kPage : alignof(T)};
    }
};

template <class T>
using LargeArray = std::vector<T, LargePages<T>>;
#else
template <class T>
using LargeArray = std::vector<T>;
#endif

} // namespace elastoon
