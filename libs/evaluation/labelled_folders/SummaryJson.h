// The machine-readable report.
#pragma once
#include <filesystem>

#include "evaluation/labelled_folders/Summary.h"

namespace hagen::evaluation {

/// Writes the entire summary as JSON:
///
///     {"hagen": version, "compiler": ..., "command_line": [...], "folders": [FOLDER, ...],
///      "settings": {key: value, ...} as requested, "label_map": FILE or null, "camera": FILE or
///      null, "max_range_m": x, "scans": n, "bootstrap": {"resamples": n, "seed": n, "level":
///      0.95}, "methods": [{"name": ..., "sweep": {"key", "value"} or null,
///                   "latency_ms": {"runs", "mean", "sd", "p50", "p95", "p99", "max"} or null,
///                   "drone": DRONE,
///                   "returns": {"all": SCORES, "by_range": [SCORES, ...], "by_altitude": [...],
///                               "by_kind": [...], "by_folder": [...]},
///                   "pixels": the same, or null without a camera}, ...],
///      "hard_sets": [{"name": a degradation,
///                     "methods": [{"name", "returns": SCORES, "roi_f1_change_points": x,
///                                  "rou_f1_change_points": x, "drone": DRONE}, ...]}, ...]}
///
///     FOLDER: {"name", "path", "recovered_sensor", "settings": {key: value, ...} with those of the
///              recording, as without a sweep, "remarks": [unused parts, ...]}
///     SCORES: {"name", "scans": n, "returns": n, "correct": x, "correct_interval": [low, high],
///              "roi": CLASS, "rou": CLASS}
///     DRONE: {"returns_above_half_metre": MISSED,
///             "returns_above_half_metre_by_range": [MISSED, ...],
///             "returns_above_half_metre_by_kind": [MISSED, ...],
///             "obstacles": MISSED, or null if they have no numbers,
///             "false_roi_on_bare_ground": n, "false_roi_on_bare_ground_per_scan": x}
///     MISSED: {"name" (of a part), "missed": n, "of": n, "missed_share": x}
///     CLASS: {"hits": n, "misses": n, "false_alarms": n, "precision": x, "recall": x, "f1": x,
///             "precision_interval": [low, high], "recall_interval": ..., "f1_interval": ...}
///
/// Undefined values are null. Throws std::runtime_error; the message names the file.
void writeJson(const std::filesystem::path& file, const Summary& summary);

}  // namespace hagen::evaluation
