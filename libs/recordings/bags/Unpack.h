#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "recordings/bags/FieldReader.h"

namespace hagen::recordings {

/// Maximum decompressed size of a chunk or message.
constexpr std::uint64_t kMaxUnpackedBytes = std::uint64_t{1} << 29;

/// Decompresses a chunk into `plain`, or returns an uncompressed chunk unchanged. `compression`: ""
/// or "none", "zstd", "lz4" (frames) or "bz2". `size`: claimed size; memory grows with the actual
/// output. Throws std::runtime_error with the reason if decompression fails or sizes differ.
ByteView unpack(const std::string& compression, ByteView packed, std::uint64_t size,
                std::vector<std::uint8_t>& plain);

/// Decompresses a zstd frame of unknown size.
void unpackZstd(ByteView packed, std::vector<std::uint8_t>& plain);

}  // namespace hagen::recordings
