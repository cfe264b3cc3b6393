#pragma once
#include <cmath>
#include <cstddef>
#include <vector>

namespace hagen::evaluation {

/// How long something took, in milliseconds; NaN where it never ran.
struct Latency {
    std::size_t runs = 0;
    double mean_ms = NAN;
    double sd_ms = NAN;  ///< of a sample: runs - 1 in the denominator; NaN below two runs
    double p50_ms = NAN, p95_ms = NAN,
           p99_ms = NAN;  ///< the smallest that this share did not exceed
    double max_ms = NAN;
};

Latency latencyOf(std::vector<double> runs_ms);

}  // namespace hagen::evaluation
