// Brings bodies that are looked at soon into the cache: among very many they are nowhere near it.
#pragma once

#include "step.h"

namespace elastoon {

inline void prefetch(const void* begin, std::size_t size) {
    constexpr std::size_t kLine = 64;
    for (std::size_t offset = 0; offset < size; offset += kLine) {
        __builtin_prefetch(static_cast<const char*>(begin) + offset);
    }
}

/// First what the slot holds.
inline void prefetchSlot(const BodySlot& body) {
    prefetch(&body, sizeof body);
}

/// A little later, what it points to.
inline void prefetchRest(const BodySlot& body) {
    prefetch(body.phase.clear_of.data(), body.phase.clear_of.size() * sizeof(KeptClear));
    if (const auto* impact = body.phase.as<Impact>()) {
        prefetch(impact, sizeof *impact);
    }
}

} // namespace elastoon
