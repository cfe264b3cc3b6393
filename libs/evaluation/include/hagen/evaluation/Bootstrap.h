#pragma once
#include <hagen/evaluation/Scores.h>
#include <cmath>
#include <cstdint>
#include <vector>

namespace hagen::evaluation {

/// A confidence interval; NaN where there is none.
struct Interval {
    double low = NAN, high = NAN;
};

struct BootstrapOptions {
    int resamples = 1000;  ///< 0: no intervals
    std::uint64_t seed = 1;
    double level = 0.95;  ///< how often the interval shall hold the true value
};

/// Intervals of the figures of Scores.
struct ScoreIntervals {
    struct OfClass {
        Interval precision, recall, f1;
    };
    OfClass roi, rou;
    Interval correct;
};

/// Confidence intervals of the summed scores of scans, by the percentile bootstrap (Efron and
/// Tibshirani, An Introduction to the Bootstrap, 1993, section 13.3): scans are drawn with
/// replacement, as many as there are, their counts are summed, and of the figures of all resamples
/// the middle `level` is the interval. Scans, not returns, are drawn, for the returns of one scan
/// are not independent of each other. Scans of one drive are not, either: then intervals are too
/// narrow. A figure that is NaN in a resample takes no part. No intervals of fewer than two scans.
ScoreIntervals bootstrapIntervals(const std::vector<Scores>& scans,
                                  const BootstrapOptions& options = {});

}  // namespace hagen::evaluation
