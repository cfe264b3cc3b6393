// Times as they were taken, and what is said of them.
#pragma once
#include <hagen/evaluation/Latency.h>
#include <cstddef>
#include <string>
#include <vector>

namespace hagen {

/// What was timed: `what` on scans of `sensor`.
struct Measured {
    std::string sensor, what;
    std::vector<double> runs_ms;
    std::size_t allocations = 0;  ///< in all these runs, after the first pass over the scans

    Latency latency() const { return latencyOf(runs_ms); }
    double allocationsARun() const {
        return runs_ms.empty()
                   ? 0
                   : static_cast<double>(allocations) / static_cast<double>(runs_ms.size());
    }
};

/// The row, or nullptr.
const Measured* find(const std::vector<Measured>& rows, const std::string& sensor,
                     const std::string& what);

/// For people: a block a sensor, medians and percentiles in microseconds.
std::string tableOf(const std::vector<Measured>& rows);

/// For programs: a list of {"sensor", "what", "median_ms", "p95_ms", "p99_ms", "max_ms", "runs",
/// "allocations"}, the last a run.
std::string jsonOf(const std::vector<Measured>& rows);

/// The slope of the line that fits log(y) over log(x) best: 1 where y grows as x does.
double exponentOf(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace hagen
