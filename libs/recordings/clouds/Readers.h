#pragma once
#include "recordings/clouds/CloudBytes.h"

namespace hagen::recordings {

constexpr std::size_t kStart = 4096;  ///< bytes of a file that show its format

// One reader per format, of a file's bytes. They throw BrokenRecording; the table is not checked
// yet.
CloudFile readPcd(const std::filesystem::path& file, Bytes bytes);
CloudFile readPly(const std::filesystem::path& file, const Bytes& bytes);
CloudFile readLas(const std::filesystem::path& file, const Bytes& bytes);
CloudFile readNpy(const std::filesystem::path& file, Bytes bytes);
CloudFile readBin(const std::filesystem::path& file, Bytes bytes);

/// Whether the first bytes of a file may be points of a .bin.
bool mayBeBin(const Bytes& start);
/// Number of float32 per point of a .bin: 4 (x, y, z, intensity; KITTI), 5 (with the ring;
/// nuScenes), or 0: not points of a LiDAR.
std::size_t binNumbersPerPoint(const Bytes& bytes);

bool isAllZero(const Bytes& bytes);

/// "it seems to be a JPEG picture", by the first bytes; empty: of no known kind.
std::string otherKindOf(const Bytes& bytes);
/// Why a file in no known format is rejected.
std::string whyNoCloud(const Bytes& start);

}  // namespace hagen::recordings
