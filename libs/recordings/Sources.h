#pragma once
#include <hagen/recordings/ScanSource.h>

namespace hagen::recordings {

// The sources of openRecording(). See CaptureSource.h for captures.

/// Each object of the rawlog is an entry; a sensory frame may contain several scans.
std::unique_ptr<ScanSource> openRawlog(const std::filesystem::path& rawlog,
                                       const SourceOptions& options);

/// Each scan is an entry. The bag is read in advance once for poses, frames and metadata, which may
/// come after the first scan.
std::unique_ptr<ScanSource> openBagScans(const std::filesystem::path& bag,
                                         const SourceOptions& options);

/// Each scan is an entry.
std::unique_ptr<ScanSource> openScanFolder(const std::filesystem::path& folder,
                                           const SourceOptions& options);

/// Each file is an entry, in the order of the names. Times are derived from the names
/// (CloudTimes.h).
std::unique_ptr<ScanSource> openClouds(const std::filesystem::path& file_or_folder,
                                       const SourceOptions& options);

}  // namespace hagen::recordings
