// Brings bodies that are looked at soon into the cache: among very many they are nowhere near it.
#pragma once

#include "step.h"

namespace elastoon {

// In a function of its own gcc sees no effect, and leaves the call out.
[[gnu::always_inline]] inline void prefetch(const void* begin, std::size_t size) {
    constexpr std::size_t kLine = 64;
    for (std::size_t offset = 0; offset < size; offset += kLine) {
        const char* line = static_cast<const char*>(begin) + offset;
#if defined(__wasm__)
        // It has no such instruction; a value that is read and not used is not waited for.
        (void)*static_cast<const volatile char*>(line);
#else
        __builtin_prefetch(line);
#endif
    }
}

/// First what the slot holds.
[[gnu::always_inline]] inline void prefetchSlot(const BodySlot& body) {
    prefetch(&body, sizeof body);
}

/// A little later, what it points to.
[[gnu::always_inline]] inline void prefetchRest(const BodySlot& body) {
    prefetch(body.phase.clear_of.data(), body.phase.clear_of.size() * sizeof(KeptClear));
    if (const auto* impact = body.phase.as<Impact>()) {
        prefetch(impact, sizeof *impact);
    }
}

} // namespace elastoon
