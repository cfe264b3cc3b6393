#pragma once
#include <hagen/evaluation/Scores.h>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

namespace hagen::evaluation {

/// A confidence interval; NaN if undefined.
struct Interval {
    double low = NAN, high = NAN;
};

struct BootstrapOptions {
    int resamples = 1000;  ///< 0: no intervals
    std::uint64_t seed = 1;
    double level = 0.95;  ///< confidence level
    /// Called before each resample; may throw to stop.
    std::function<void()> continuing = [] {};
};

/// Confidence intervals of the ratios of Scores.
struct ScoreIntervals {
    struct OfClass {
        Interval precision, recall, f1;
    };
    OfClass roi, rou;
    Interval correct;
};

/// Returns confidence intervals of the summed scores of scans, by the percentile bootstrap (Efron
/// and Tibshirani, An Introduction to the Bootstrap, 1993, section 13.3) over scans, because the
/// returns of one scan are not independent. Scans of the same drive are not independent either,
/// which makes the intervals too narrow. Ratios that are NaN in a resample are excluded. There are
/// no intervals for fewer than two scans.
ScoreIntervals bootstrapIntervals(const std::vector<Scores>& scans,
                                  const BootstrapOptions& options = {});

}  // namespace hagen::evaluation
