#include "recordings/RecordingKind.h"

#include <hagen/sensors/CaptureFile.h>
#include "base/Folder.h"
#include "recordings/bags/BagFile.h"
#include "recordings/clouds/CloudFile.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace hagen::recordings {
namespace {

namespace fs = std::filesystem;

/// Recordings in a folder, sorted by name.
std::vector<fs::path> recordingsIn(const fs::path& folder) {
    std::vector<fs::path> found;
    for (const fs::path& path : base::entriesOf(folder)) {
        const bool is_other_file = fs::is_regular_file(path) &&
                                   (sensors::isCapture(path) || path.extension() == ".rawlog");
        const bool may_be_bag = fs::is_regular_file(path) || fs::is_directory(path);
        if (is_other_file || (may_be_bag && isBag(path))) found.push_back(path);
    }
    return found;
}

bool isScanFolder(const fs::path& folder) {
    std::error_code unreadable;
    const std::vector<fs::path> scans = base::entriesOf(folder / "velodyne", unreadable);
    return std::any_of(scans.begin(), scans.end(),
                       [](const fs::path& file) { return file.extension() == ".bin"; });
}

bool hasClouds(const fs::path& folder) {
    const std::vector<fs::path> entries = base::entriesOf(folder);
    return std::any_of(entries.begin(), entries.end(), [](const fs::path& entry) {
        return !fs::is_directory(entry) && hasCloudName(entry);
    });
}

/// The first subfolder with scans, up to two levels deep; empty if there is none. Skips folders
/// without read permission.
fs::path scansWithin(const fs::path& folder, int depth = 2) {
    std::error_code unreadable;
    for (const fs::path& within : base::entriesOf(folder, unreadable)) {
        if (!fs::is_directory(within, unreadable)) continue;
        if (base::entriesOf(within, unreadable).empty() || unreadable) continue;
        if (isScanFolder(within) || hasClouds(within)) return within;
        const fs::path deeper = depth > 1 ? scansWithin(within, depth - 1) : fs::path();
        if (!deeper.empty()) return deeper;
    }
    return {};
}

/// Why a folder is not a recording, with a hint on what to pass instead.
std::string whyNoRecording(const fs::path& folder) {
    const std::vector<fs::path> recordings = recordingsIn(folder);
    if (!recordings.empty()) {
        return "is a folder with " + std::to_string(recordings.size()) +
               (recordings.size() == 1 ? " recording; pass it: "
                                       : " recordings; pass one of them: ") +
               recordings[0].string();
    }
    const fs::path scans = scansWithin(folder);
    return "not a scan folder (no subfolder 'velodyne' with .bin files), not a folder of point "
           "clouds (.pcd, .ply, .las, .npy, .bin), and contains no recordings "
           "(.rawlog, .pcap, .bag, .mcap, .db3)" +
           (scans.empty() ? "" : "; there are scans in " + scans.string() + ": pass such a folder");
}

RecordingKind kindOfFolder(const fs::path& folder) {
    const bool has_clouds = hasClouds(folder);
    // Ignore a bag beside clouds, unless it has metadata.
    if (isBag(folder) && (!has_clouds || fs::exists(folder / "metadata.yaml"))) {
        return RecordingKind::Bag;
    }
    if (isScanFolder(folder)) return RecordingKind::ScanFolder;
    if (has_clouds) return RecordingKind::Clouds;
    throw std::runtime_error(folder.string() + ": " + whyNoRecording(folder));
}

}  // namespace

RecordingKind detectKind(const fs::path& recording) {
    if (!fs::exists(recording)) {
        throw std::runtime_error(recording.string() + ": no such file or folder");
    }
    if (fs::is_directory(recording)) return kindOfFolder(recording);
    if (!fs::is_regular_file(recording)) {
        throw std::runtime_error(recording.string() +
                                 ": is a pipe or a device; save its content to a file first, "
                                 "because recordings are read more than once");
    }
    if (isBag(recording)) return RecordingKind::Bag;
    if (sensors::isCapture(recording)) return RecordingKind::Capture;
    const bool is_cloud = cloudFormatOf(recording).has_value() || hasCloudName(recording);
    return is_cloud ? RecordingKind::Clouds : RecordingKind::Rawlog;
}

}  // namespace hagen::recordings
