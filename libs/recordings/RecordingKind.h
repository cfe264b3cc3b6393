#pragma once
#include <filesystem>

namespace hagen::recordings {

enum class RecordingKind { Rawlog, Capture, Bag, ScanFolder, Clouds };

/// Detects the kind of a file by its content, and of a folder by its files. Unknown files are
/// treated as rawlogs, whose reader reports the likely format. Throws std::runtime_error naming the
/// path if it does not exist, is a pipe or a device, or is a folder of unknown kind.
RecordingKind detectKind(const std::filesystem::path& recording);

}  // namespace hagen::recordings
