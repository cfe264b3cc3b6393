#pragma once
#include <hagen/convert/Conversion.h>
#include <filesystem>
#include <ostream>

namespace hagen::convert {

/// Prints the results of a conversion as JSON:
///
///     {"hagen": version, "input": ..., "outputs": {...}, "settings": {key: value, ...},
///      "sensors": {label: text},
///      "recovered_sensors": {label: {"name": a model or "recovered", "beams": n (image rows),
///                                    "beams_seen": n, "share": 0 ... 1 (returns on a beam),
///                                    "has_rings": false if the rows are virtual,
///                                    "columns": n (of the image)}},
///      "poses": {"source": ..., "scans_with_pose": n},
///      "scans_in_map": n (only with an OctoMap),
///      "entries": n, "unreadable_scans": n, "left_out_before": n,
///      "returns": {"all": n, "roi": n, "rou": n, "unclassified": n},
///      "returns_masked": n (of the unclassified: the airframe's),
///      "latency_ms": {"scans": n, "p50": ..., "p95": ..., "p99": ..., "max": ...},
///      "scans": [{"scan": n, "sensor": label, "name": ..., "time_s": ..., "returns": n, "roi": n,
///                 "rou": n, "unclassified": n, "returns_masked": n, "obstacles": n,
///                 "nearest_roi_m": x or null, "latency_ms": ...}, ...]}
///
/// Latency is the time from the complete observation in memory to its labels, without creating the
/// clouds. Scans segmented concurrently (see Conversion::jobs) slow each other down slightly.
/// Everything except latencies is reproducible.
void printConversionStatistics(std::ostream& out, const Conversion& conversion,
                               const ConversionReport& report);
/// The same into a file. Throws std::runtime_error naming the file.
void writeConversionStatistics(const std::filesystem::path& file, const Conversion& conversion,
                               const ConversionReport& report);

}  // namespace hagen::convert
