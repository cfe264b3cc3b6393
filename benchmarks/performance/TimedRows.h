// What was timed, as a table for people and as JSON for programs.
#pragma once
#include <hagen/evaluation/Latency.h>
#include <filesystem>
#include <string>
#include <vector>

namespace hagen {

struct TimedRow {
    std::string sensor, what;
    evaluation::Latency latency;  ///< of a run: a scan
    double allocations = 0;       ///< a run, after the first pass over the scans
};

/// The row of this name, or nullptr.
const TimedRow* find(const std::vector<TimedRow>& rows, const std::string& sensor,
                     const std::string& what);

/// A block a sensor, medians and percentiles in microseconds.
std::string tableOf(const std::vector<TimedRow>& rows);

/// A list of {"sensor", "what", "median_ms", "p95_ms", "p99_ms", "max_ms", "runs", "allocations"},
/// the last a run.
std::string jsonOf(const std::vector<TimedRow>& rows);
/// Reads that list. Throws std::runtime_error, naming the file.
std::vector<TimedRow> readTimedRows(const std::filesystem::path& file);

/// The slope of the line that fits log(y) over log(x) best: 1 where y grows as x does.
double exponentOf(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace hagen
