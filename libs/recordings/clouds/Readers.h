#pragma once
#include "recordings/clouds/CloudBytes.h"

namespace hagen::recordings {

constexpr std::size_t kStart = 4096;  ///< bytes that suffice to detect a file's format

// One reader of a file's bytes per format. Readers throw BrokenRecording and do not check the
// table.
CloudFile readPcd(const std::filesystem::path& file, Bytes bytes);
CloudFile readPly(const std::filesystem::path& file, const Bytes& bytes);
CloudFile readLas(const std::filesystem::path& file, const Bytes& bytes);
CloudFile readNpy(const std::filesystem::path& file, Bytes bytes);
CloudFile readBin(const std::filesystem::path& file, Bytes bytes);

/// True if the first bytes of a file may be points of a .bin.
bool mayBeBin(const Bytes& start);
/// Number of float32 per point of a .bin: 4 (x, y, z, intensity; KITTI), 5 (with the ring;
/// nuScenes), or 0: not LiDAR points.
std::size_t binNumbersPerPoint(const Bytes& bytes);

bool isAllZero(const Bytes& bytes);

/// "it seems to be a JPEG picture", by the first bytes; empty: unknown.
std::string otherKindOf(const Bytes& bytes);
/// The reason for rejecting a file of unknown format.
std::string whyNoCloud(const Bytes& start);

}  // namespace hagen::recordings
