#pragma once
#include "recordings/clouds/CloudBytes.h"

namespace hagen::recordings {

constexpr std::size_t kKittiNumbers = 4;  ///< x, y, z, intensity
constexpr std::size_t kStart = 4096;      ///< number of bytes used to detect a file's format

// Readers of file contents, one per format. They throw BrokenRecording and do not validate the
// table.
CloudFile readPcd(const std::filesystem::path& file, Bytes bytes);
CloudFile readPly(const std::filesystem::path& file, const Bytes& bytes);
CloudFile readLas(const std::filesystem::path& file, const Bytes& bytes);
CloudFile readNpy(const std::filesystem::path& file, Bytes bytes);
CloudFile readBin(const std::filesystem::path& file, Bytes bytes, const BinFields& stated = {});

/// True if a file that starts with these bytes may be a .bin.
bool mayBeBin(const Bytes& start);
/// Number of float32 values per point in a .bin: 4 (x, y, z, intensity; KITTI), 5 (with ring;
/// nuScenes), or 0 if they are not LiDAR points.
std::size_t binNumbersPerPoint(const Bytes& bytes);

/// Throws BrokenRecording if neighbouring points contradict this layout of a .bin and fit another.
void checkBinLayout(const std::filesystem::path& file, const Bytes& bytes, std::size_t numbers);

bool isAllZero(const Bytes& bytes);

/// Such as "it seems to be a JPEG picture", from the first bytes; empty if unknown.
std::string otherKindOf(const Bytes& bytes);
/// Why a file of unknown format is rejected.
std::string whyNoCloud(const Bytes& start);

}  // namespace hagen::recordings
