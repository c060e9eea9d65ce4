// Numbers as little-endian bytes and back, and the sealed envelope that such bytes travel in. docs/snapshot.md.
#pragma once

#include "elastoon/ids.h"
#include "elastoon/math.h"
#include "elastoon/result.h"

#include <algorithm>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <variant>
#include <vector>

namespace elastoon {

template <class T>
concept PlainNumber = std::unsigned_integral<T> || std::same_as<T, double> || std::is_enum_v<T>;

/// The unsigned number that goes into the bytes.
template <PlainNumber T>
[[nodiscard]] auto bitsOf(T value) {
    if constexpr (std::is_enum_v<T>) {
        return static_cast<std::underlying_type_t<T>>(value);
    } else if constexpr (std::same_as<T, double>) {
        return std::bit_cast<std::uint64_t>(value);
    } else if constexpr (std::same_as<T, bool>) {
        return static_cast<std::uint8_t>(value);
    } else {
        return value;
    }
}

/// The number whose bytes in memory are those of this one in little-endian order; and back.
template <std::unsigned_integral T>
[[nodiscard]] T littleEndian(T value) {
    if constexpr (std::endian::native == std::endian::little) {
        return value;
    } else {
        T turned = 0;
        for (std::size_t i = 0; i < sizeof(T); ++i) {
            turned = static_cast<T>(turned << 8 | (value >> 8 * i & 0xff));
        }
        return turned;
    }
}

/// Writes over what the vector holds and grows it as needed, so that a vector that is used again costs no allocation.
class ByteWriter {
public:
    explicit ByteWriter(std::vector<std::byte>& out) : out_(out) { out_.resize(out_.capacity()); }

    template <class... T>
    void operator()(const T&... items) {
        (put(items), ...);
    }
    /// The number of items of a list.
    template <class List>
    void sized(const List& list, std::size_t /*least_bytes*/) {
        put(static_cast<std::uint32_t>(list.size()));
    }
    /// Which alternative a variant holds.
    template <class Variant>
    void choice(const Variant& variant) {
        put(static_cast<std::uint8_t>(variant.index()));
    }
    template <PlainNumber T>
    void putAt(std::size_t place, T value) {
        const auto bits = littleEndian(bitsOf(value));
        std::memcpy(out_.data() + place, &bits, sizeof bits);
    }
    [[nodiscard]] std::size_t size() const { return size_; }
    /// Cuts the vector to what was written.
    void finish() { out_.resize(size_); }

private:
    template <PlainNumber T>
    void put(T value) {
        if (size_ + 8 > out_.size()) {
            out_.resize(std::max<std::size_t>(256, 2 * out_.size()));
        }
        putAt(size_, value);
        size_ += sizeof bitsOf(value);
    }
    void put(const Vec3& v) { (*this)(v.x, v.y, v.z); }
    void put(const Quat& q) { (*this)(q.x, q.y, q.z, q.w); }
    template <class Tag>
    void put(const Id<Tag>& id) {
        (*this)(id.slot, id.generation);
    }

    std::vector<std::byte>& out_;
    std::size_t size_ = 0;
};

/// Reads what a ByteWriter wrote. Trusts nothing: where the bytes end too soon, or hold what cannot be, it goes bad and
/// gives zeros from then on.
class ByteReader {
public:
    explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    template <class... T>
    void operator()(T&... items) {
        (get(items), ...);
    }
    /// Gives the list as many items as the bytes say, if that many of at least so many bytes can follow.
    template <class List>
    void sized(List& list, std::size_t least_bytes) {
        std::uint32_t count = 0;
        get(count);
        if (count > left() / least_bytes) {
            spoil();
            count = 0;
        }
        list.resize(count);
    }
    template <class Variant>
    void choice(Variant& variant) {
        std::uint8_t index = 0;
        get(index);
        choose<0>(variant, index);
    }
    [[nodiscard]] bool good() const { return good_; }
    [[nodiscard]] std::size_t left() const { return bytes_.size() - place_; }
    void spoil() { good_ = false; }

private:
    template <PlainNumber T>
    void get(T& value) {
        using Bits = decltype(bitsOf(T{}));
        Bits bits = 0;
        if (good_ && left() >= sizeof(Bits)) {
            std::memcpy(&bits, bytes_.data() + place_, sizeof bits);
            bits = littleEndian(bits);
            place_ += sizeof(Bits);
        } else {
            spoil();
        }
        if constexpr (std::same_as<T, bool>) {
            good_ = good_ && bits <= 1;
            value = bits == 1;
        } else if constexpr (std::same_as<T, double>) {
            value = std::bit_cast<double>(bits);
        } else {
            value = static_cast<T>(bits);
        }
    }
    void get(Vec3& v) { (*this)(v.x, v.y, v.z); }
    void get(Quat& q) { (*this)(q.x, q.y, q.z, q.w); }
    template <class Tag>
    void get(Id<Tag>& id) {
        (*this)(id.slot, id.generation);
    }
    template <std::size_t i, class Variant>
    void choose(Variant& variant, std::size_t index) {
        if constexpr (i < std::variant_size_v<Variant>) {
            if (index != i) {
                choose<i + 1>(variant, index);
            } else if (variant.index() != i) {
                variant.template emplace<i>();
            }
        } else {
            spoil();
        }
    }

    std::span<const std::byte> bytes_;
    std::size_t place_ = 0;
    bool good_ = true;
};

/// What bytes say of themselves: eight letters, a version, the length, and a checksum over all the rest. Any one word
/// of eight bytes that differs gives another checksum.
struct Envelope {
    const char* letters; ///< eight
    std::uint32_t version;
    const char* what; ///< for messages: "snapshot"
};
inline constexpr std::size_t kEnvelopeBytes = 32;

/// Leaves room for the envelope; to be called before anything is written.
void beginEnvelope(ByteWriter& writer, const Envelope& envelope, std::uint32_t flags);
/// Fills in the length and the checksum, and cuts the bytes.
void closeEnvelope(ByteWriter& writer, std::vector<std::byte>& bytes);
struct Opened {
    std::uint32_t flags = 0;
    std::span<const std::byte> inside;
};
[[nodiscard]] Result<Opened> openEnvelope(std::span<const std::byte> bytes, const Envelope& envelope);
/// The checksum that bytes with an envelope should have: over all but its own place.
[[nodiscard]] std::uint64_t checksumOf(std::span<const std::byte> bytes);
inline constexpr std::size_t kChecksumPlace = 24;

} // namespace elastoon
