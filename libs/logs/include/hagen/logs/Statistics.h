#pragma once
#include <hagen/logs/Conversion.h>
#include <filesystem>

namespace hagen::logs {

/// Writes what a conversion counted as JSON:
///
///     {"hagen": version, "input": ..., "outputs": {...}, "settings": {key: value, ...},
///      "sensors": {label: text}, "poses": {"source": ..., "scans_with_pose": n},
///      "scans_in_map": n (of an OctoMap alone),
///      "entries": n, "unreadable_scans": n, "left_out_before": n,
///      "returns": {"all": n, "roi": n, "rou": n, "unclassified": n},
///      "latency_ms": {"scans": n, "p50": ..., "p95": ..., "p99": ..., "max": ...},
///      "scans": [{"entry": n, "sensor": label, "name": ..., "time_s": ..., "returns": n, "roi": n,
///                 "rou": n, "unclassified": n, "obstacles": n, "nearest_roi_m": x or null,
///                 "latency_ms": ...}, ...]}
///
/// A latency is the time from a scan's last packet, the whole observation being in memory, to its
/// labels; clouds are made after that, and do not count. Where scans are segmented side by side
/// (see Conversion::jobs) they hinder one another a little. Latencies differ from run to run, all
/// else does not. Throws std::runtime_error, naming the file.
void writeStatistics(const std::filesystem::path& file, const Conversion& conversion,
                     const ConversionReport& report);

}  // namespace hagen::logs
