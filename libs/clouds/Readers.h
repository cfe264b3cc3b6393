#pragma once
#include "CloudBytes.h"

namespace hagen::clouds {

constexpr std::size_t kStart = 4096;  ///< bytes of a file that tell its format

// One reader per format, of a file's bytes. They throw BrokenCloud; the table is not checked yet.
CloudFile readPcd(const std::filesystem::path& file, Bytes bytes);
CloudFile readPly(const std::filesystem::path& file, const Bytes& bytes);
CloudFile readLas(const std::filesystem::path& file, const Bytes& bytes);
CloudFile readNpy(const std::filesystem::path& file, Bytes bytes);
CloudFile readBin(const std::filesystem::path& file, Bytes bytes);

/// How many float32 a point of a .bin has: 4 (x, y, z, intensity, as of KITTI) or 5 (with the ring,
/// as of nuScenes). None: these are no points of a LiDAR.
enum class BinPoint { None, Four, Five, FourOrFive };

/// What the first bytes of a file tell.
BinPoint binPointOf(const Bytes& start);
/// The number, once all bytes are there.
std::size_t numbersPerBinPoint(BinPoint of_start, const Bytes& all);

}  // namespace hagen::clouds
