#pragma once
#include <cmath>
#include <cstddef>
#include <vector>

namespace hagen::evaluation {

/// Statistics of run times, in milliseconds; NaN without runs.
struct Latency {
    std::size_t runs = 0;
    double mean_ms = NAN;
    double sd_ms =
        NAN;  ///< sample standard deviation (denominator runs - 1); NaN for fewer than two runs
    double p50_ms = NAN, p95_ms = NAN,
           p99_ms = NAN;  ///< percentiles (nearest rank)
    double max_ms = NAN;
};

Latency latencyOf(std::vector<double> runs_ms);

}  // namespace hagen::evaluation
