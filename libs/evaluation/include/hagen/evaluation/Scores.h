#pragma once
#include <hagen/range_image/Label.h>
#include <cstdint>

namespace hagen::evaluation {

/// Precision, recall and F1 of one class, and the counts behind them.
struct ClassScore {
    std::int64_t hits = 0;    ///< of the class, and found to be
    std::int64_t misses = 0;  ///< of the class, and not found to be (unclassified counts here)
    std::int64_t false_alarms = 0;  ///< found to be of the class, and of the other

    double precision() const;  ///< NaN where nothing was found
    double recall() const;     ///< NaN where nothing is of the class
    double f1() const;         ///< NaN where there is neither

    ClassScore& operator+=(const ClassScore& other);
};

/// Scores of both classes. Sums are micro-averages: counts are added over returns and scans before
/// ratios are taken.
struct Scores {
    ClassScore roi, rou;

    /// Returns that were scored.
    std::int64_t returns() const;
    /// Share of the returns that were found to be what they are; NaN where there are none.
    double correct() const;

    Scores& operator+=(const Scores& other);
};

/// Adds one return, or one pixel. Nothing is added where its true label is Unclassified.
void addScore(Label truth, Label found, Scores& scores);

}  // namespace hagen::evaluation
