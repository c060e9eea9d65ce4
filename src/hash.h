// A 64-bit hash over numbers by their bits: FNV-1a over 64-bit words, with a final mix.
#pragma once

#include <bit>
#include <cstdint>

namespace elastoon {

class Hash {
public:
    void add(std::uint64_t word) {
        state_ = (state_ ^ word) * 0x100000001b3ULL;
        state_ ^= state_ >> 32;
    }
    /// Zero has one hash, whatever its sign.
    void add(double number) { add(std::bit_cast<std::uint64_t>(number == 0.0 ? 0.0 : number)); }

    [[nodiscard]] std::uint64_t value() const {
        std::uint64_t mixed = state_ * 0x9e3779b97f4a7c15ULL;
        mixed ^= mixed >> 29;
        return mixed * 0xbf58476d1ce4e5b9ULL;
    }

private:
    std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

} // namespace elastoon
