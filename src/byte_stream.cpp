// See byte_stream.h.
#include "byte_stream.h"

#include "hash.h"

#include <array>
#include <string>

namespace elastoon {

namespace {

constexpr std::size_t kVersionPlace = 8;
constexpr std::size_t kLengthPlace = 16;

std::uint64_t wordAt(std::span<const std::byte> bytes, std::size_t place, std::size_t size = 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + place, size);
    return littleEndian(word);
}

std::string hexOf(std::uint64_t value) {
    constexpr char kDigits[] = "0123456789abcdef";
    std::string text = "0x";
    for (int shift = 60; shift >= 0; shift -= 4) {
        text += kDigits[value >> shift & 15];
    }
    return text;
}

} // namespace

// Four hashes side by side, so that one need not wait for the other.
std::uint64_t checksumOf(std::span<const std::byte> bytes) {
    std::array<Hash, 4> lanes;
    std::size_t place = 0;
    for (; place + 32 <= bytes.size(); place += 32) {
        for (std::size_t lane = 0; lane < 4; ++lane) {
            const std::size_t at = place + 8 * lane;
            lanes[lane].add(at == kChecksumPlace ? 0 : wordAt(bytes, at));
        }
    }
    for (; place < bytes.size(); place += 8) {
        lanes[0].add(wordAt(bytes, place, std::min<std::size_t>(8, bytes.size() - place)));
    }
    Hash all;
    for (const Hash& lane : lanes) {
        all.add(lane.value());
    }
    all.add(std::uint64_t{bytes.size()});
    return all.value();
}

void beginEnvelope(ByteWriter& writer, const Envelope& envelope, std::uint32_t flags) {
    for (int i = 0; i < 8; ++i) {
        writer(static_cast<std::uint8_t>(envelope.letters[i]));
    }
    writer(envelope.version, flags, std::uint64_t{0}, std::uint64_t{0});
}

void closeEnvelope(ByteWriter& writer, std::vector<std::byte>& bytes) {
    writer.putAt(kLengthPlace, std::uint64_t{writer.size()});
    writer.finish();
    writer.putAt(kChecksumPlace, checksumOf(bytes));
}

Result<Opened> openEnvelope(std::span<const std::byte> bytes, const Envelope& envelope) {
    const std::string what = envelope.what;
    if (bytes.size() < kEnvelopeBytes) {
        return Error{"has " + std::to_string(bytes.size()) + " bytes; a " + what + " has at least " +
                         std::to_string(kEnvelopeBytes),
                     what};
    }
    for (std::size_t i = 0; i < 8; ++i) {
        if (static_cast<char>(bytes[i]) != envelope.letters[i]) {
            return Error{"does not begin with the letters " + std::string(envelope.letters, 8) + ": it is no " + what,
                         what};
        }
    }
    const std::uint64_t version = wordAt(bytes, kVersionPlace, 4);
    if (version != envelope.version) {
        return Error{"is of version " + std::to_string(version) + "; this library reads and writes version " +
                         std::to_string(envelope.version),
                     what};
    }
    const std::uint64_t length = wordAt(bytes, kLengthPlace);
    if (length != bytes.size()) {
        return Error{"should have " + std::to_string(length) + " bytes and has " + std::to_string(bytes.size()) +
                         ": it was cut or added to",
                     what};
    }
    const std::uint64_t checksum = wordAt(bytes, kChecksumPlace);
    const std::uint64_t should = checksumOf(bytes);
    if (checksum != should) {
        return Error{"has the checksum " + hexOf(checksum) + " and should have " + hexOf(should) + ": it is damaged",
                     what};
    }
    return Opened{static_cast<std::uint32_t>(wordAt(bytes, kVersionPlace + 4, 4)), bytes.subspan(kEnvelopeBytes)};
}

} // namespace elastoon
