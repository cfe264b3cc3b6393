#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "recordings/bags/FieldReader.h"

namespace hagen::recordings {

/// The most bytes that a chunk or message may unpack to.
constexpr std::uint64_t kMaxUnpackedBytes = std::uint64_t{1} << 29;

/// Unpacks a chunk into `plain`; one that is not packed is returned as it is. Compression is "" or
/// "none", "zstd", "lz4" (frames) or "bz2". `size` is what it claims to unpack to; memory grows
/// with what really comes. Throws std::runtime_error saying what is wrong, also if the sizes
/// differ.
ByteView unpack(const std::string& compression, ByteView packed, std::uint64_t size,
                std::vector<std::uint8_t>& plain);

/// Unpacks a zstd frame of unknown size.
void unpackZstd(ByteView packed, std::vector<std::uint8_t>& plain);

}  // namespace hagen::recordings
