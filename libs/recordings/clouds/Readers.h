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

/// Number of float32 per point of a .bin: 4 (x, y, z, intensity; KITTI) or 5 (with the ring;
/// nuScenes). None: not points of a LiDAR.
enum class BinPoint { None, Four, Five, FourOrFive, FiveOrNone };

/// Judges the first bytes of a file.
BinPoint binPointOf(const Bytes& start);
/// The first bytes; if these are zero, as in a scan that begins with rows of sky, those from the
/// first return on.
Bytes tellingBytes(const Bytes& bytes);
/// Which of two it is, once all bytes are there.
BinPoint binPointOf(BinPoint of_start, const Bytes& all);

bool isAllZero(const Bytes& bytes);

/// What is said of a file in no format that is read.
std::string whyNoCloud(const Bytes& start);

}  // namespace hagen::recordings
