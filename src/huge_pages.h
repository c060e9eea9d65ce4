// Memory in huge pages, where the system has such: with small ones the processor looks up where a page is about as
// often as what is in it.
#pragma once

#include <cstddef>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace elastoon {

inline constexpr std::size_t kHugePage = std::size_t{2} << 20U; ///< bytes

/// Before the memory is used; for what of it is whole huge pages. It may be refused; then the pages are small.
inline void askForHugePages([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__)
    if (bytes >= kHugePage) {
        (void)madvise(begin, bytes - bytes % kHugePage, MADV_HUGEPAGE);
    }
#endif
}

} // namespace elastoon
