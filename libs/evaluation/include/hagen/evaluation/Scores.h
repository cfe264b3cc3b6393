#pragma once
#include <hagen/scan/Label.h>
#include <cstdint>

namespace hagen::evaluation {

/// Precision, recall and F1 of one class, and the underlying counts.
struct ClassScore {
    std::int64_t hits = 0;          ///< true positives
    std::int64_t misses = 0;        ///< false negatives (unclassified returns included)
    std::int64_t false_alarms = 0;  ///< false positives: returns of the other class

    double precision() const;  ///< NaN if nothing was labelled as this class
    double recall() const;     ///< NaN if nothing belongs to this class
    double f1() const;         ///< NaN if both are empty

    ClassScore& operator+=(const ClassScore& other);
};

/// Scores of both classes. Sums are micro-averages: counts are summed over returns and scans before
/// ratios are computed.
struct Scores {
    ClassScore roi, rou;

    /// Number of scored returns.
    std::int64_t returns() const;
    /// Fraction of returns with the correct label; NaN without returns.
    double correct() const;

    Scores& operator+=(const Scores& other);
};

/// Adds one return or pixel, unless its ground-truth label is Unclassified.
void addScore(Label truth, Label found, Scores& scores);

}  // namespace hagen::evaluation
