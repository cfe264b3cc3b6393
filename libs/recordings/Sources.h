#pragma once
#include <hagen/recordings/ScanSource.h>

namespace hagen::recordings {

// The sources of openRecording().

/// Opens a capture of LiDAR packets. Each turn of a sensor is an entry.
std::unique_ptr<ScanSource> openCaptureScans(const std::filesystem::path& capture,
                                             const SourceOptions& options);

/// Opens a rawlog. Each object is an entry; a sensory frame may contain several scans.
std::unique_ptr<ScanSource> openRawlog(const std::filesystem::path& rawlog,
                                       const SourceOptions& options);

/// Opens a bag. Each scan is an entry. Reads the bag once in advance for poses, frames and
/// metadata, which may be stored after the first scan.
std::unique_ptr<ScanSource> openBagScans(const std::filesystem::path& bag,
                                         const SourceOptions& options);

/// Opens a scan folder. Each scan is an entry.
std::unique_ptr<ScanSource> openScanFolder(const std::filesystem::path& folder,
                                           const SourceOptions& options);

/// Opens a cloud file or a folder of them. Each file is an entry, in the order of names. Times are
/// derived from names (CloudTimes.h).
std::unique_ptr<ScanSource> openClouds(const std::filesystem::path& file_or_folder,
                                       const SourceOptions& options);

}  // namespace hagen::recordings
