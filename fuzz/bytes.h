// What fuzz targets share: a stop with a message, and numbers out of bytes.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>

namespace elastoon {

inline void demand(bool condition, const char* what) {
    if (!condition) {
        std::fprintf(stderr, "elastoon_fuzz: %s\n", what);
        std::abort();
    }
}

class Bytes {
public:
    Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}
    [[nodiscard]] bool any() const { return left_ > 0; }
    std::uint8_t next() {
        if (left_ == 0) {
            return 0;
        }
        --left_;
        return *data_++;
    }
    double raw() {
        std::uint64_t bits = 0;
        for (int i = 0; i < 8; ++i) {
            bits = bits << 8 | next();
        }
        double value = 0.0;
        std::memcpy(&value, &bits, sizeof value);
        return value;
    }

private:
    const std::uint8_t* data_;
    std::size_t left_;
};

/// A small whole number, or something near to or far from one.
inline double coordinate(Bytes& bytes) {
    const std::uint8_t kind = bytes.next();
    const auto small = static_cast<double>(static_cast<std::int8_t>(bytes.next()));
    switch (kind % 16) {
    case 0:
        return small * 1e-17;
    case 1:
        return small + 1e-15 * bytes.next();
    case 2:
        return small + 1e-11 * bytes.next();
    case 3:
        return small * 1e-9;
    case 4:
        return small * 7.8e6;
    case 5:
        return small / 3.0;
    case 6:
        return bytes.raw();
    case 7:
        return small * std::numeric_limits<double>::denorm_min();
    case 8:
        return 1.0 + small * std::numeric_limits<double>::epsilon();
    default:
        return small;
    }
}

} // namespace elastoon
