// Small values that name bodies and obstacles of a world, with a generation so that a stale one is recognised.
#pragma once

#include <compare>
#include <cstdint>

namespace elastoon {

/// Names one object of one world. The default value names nothing.
/// A slot is used again after its object is removed, with the next generation: ids of removed objects stay invalid.
template <class Tag>
struct Id {
    std::uint32_t slot = 0;       ///< index + 1; 0 is nothing
    std::uint32_t generation = 0; ///< counts the uses of the slot

    [[nodiscard]] explicit operator bool() const { return slot != 0; }
    friend auto operator<=>(const Id&, const Id&) = default;
};

using BodyId = Id<struct BodyTag>;
using ObstacleId = Id<struct ObstacleTag>;

} // namespace elastoon
