#include "recordings/bags/Unpack.h"

#include <algorithm>
#include <stdexcept>

#include "recordings/Unpacker.h"

namespace hagen::recordings {
namespace {

[[noreturn]] void failPacked(const std::string& why) {
    throw std::runtime_error("cannot be decompressed: " + why);
}

/// Decompresses all bytes, at most `max`. Memory grows with the output.
void unpackAll(ByteView packed, std::uint64_t max, std::vector<std::uint8_t>& plain) {
    constexpr std::uint64_t kFirst = 1 << 16;
    std::size_t used = 0;
    plain.resize(static_cast<std::size_t>(std::min(max + 1, kFirst)));
    try {
        Unpacker unpacker(packed.data, packed.size);
        while ((used += unpacker.read(plain.data() + used, plain.size() - used)) == plain.size()) {
            if (used > max) throw std::runtime_error("it is larger than it claims");
            plain.resize(static_cast<std::size_t>(std::min<std::uint64_t>(max + 1, 2 * used)));
        }
        if (unpacker.consumed() < packed.size) throw std::runtime_error("extra data at its end");
    } catch (const std::runtime_error& e) {
        failPacked(e.what());
    }
    plain.resize(used);
}

}  // namespace

ByteView unpack(const std::string& compression, ByteView packed, std::uint64_t size,
                std::vector<std::uint8_t>& plain) {
    if (size > kMaxUnpackedBytes) {
        failPacked("it claims a size of " + std::to_string(size) + " bytes, more than " +
                   std::to_string(kMaxUnpackedBytes));
    }
    const bool is_plain = compression.empty() || compression == "none";
    if (!is_plain && compression != "zstd" && compression != "lz4" && compression != "bz2") {
        failPacked("its compression '" + compression.substr(0, 32) +
                   "' is not supported (none, zstd, lz4, bz2)");
    }
    if (!is_plain) unpackAll(packed, size, plain);
    const ByteView found = is_plain ? packed : ByteView{plain.data(), plain.size()};
    if (found.size == size) return found;
    failPacked("it has " + std::to_string(found.size) + " bytes, but claims " +
               std::to_string(size));
}

void unpackZstd(ByteView packed, std::vector<std::uint8_t>& plain) {
    unpackAll(packed, kMaxUnpackedBytes, plain);
}

}  // namespace hagen::recordings
