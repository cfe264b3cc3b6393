// Measured times, as a table and as JSON.
#pragma once
#include <filesystem>
#include <string>
#include <vector>
#include "evaluation/Latency.h"

namespace hagen {

struct TimedRow {
    std::string sensor, what;
    int pixels = 0;            ///< of the image
    evaluation::Latency warm;  ///< per scan, directly after the previous scan
    evaluation::Latency cold;  ///< with data out of the caches; NaN for stages
    double allocations = 0;    ///< per scan, after the first pass over the scans
};

/// Returns the row of this name, or nullptr.
const TimedRow* find(const std::vector<TimedRow>& rows, const std::string& sensor,
                     const std::string& what);

/// Returns one block per sensor, with percentiles in microseconds.
std::string tableOf(const std::vector<TimedRow>& rows);

/// Returns a list of {"sensor", "what", "pixels", "allocations", "warm", "cold"}, the last two with
/// {"runs", "p50_ms", "p95_ms", "p99_ms"}.
std::string jsonOf(const std::vector<TimedRow>& rows);
/// Reads the output of jsonOf(). Throws std::runtime_error naming the file.
std::vector<TimedRow> readTimedRows(const std::filesystem::path& file);

/// Returns the slope of the least-squares line through log(y) over log(x): 1 if y is proportional
/// to x.
double exponentOf(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace hagen
