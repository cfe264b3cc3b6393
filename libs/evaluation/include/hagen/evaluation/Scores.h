#pragma once
#include <hagen/range_image/Label.h>
#include <hagen/range_image/Scan.h>
#include <cstdint>
#include <vector>

namespace hagen {

/// Precision, recall and F1 of one class.
struct ClassScore {
    std::int64_t hits = 0;    ///< of the class, and found to be
    std::int64_t misses = 0;  ///< of the class, and not found to be (unclassified counts here)
    std::int64_t false_alarms = 0;  ///< found to be of the class, and of the other

    double precision() const;  ///< NaN where nothing was found
    double recall() const;     ///< NaN where nothing is of the class
    double f1() const;         ///< NaN where there is neither
};

/// Scores over returns, micro-averaged: counts are summed over all scans before ratios are taken.
struct Scores {
    ClassScore roi, rou;
};

/// Adds the returns of one scan. Returns whose true label is Unclassified, or which are farther
/// than `max_range_m`, are left out. `truth` and `found` have an entry a return, else
/// std::invalid_argument; truth holds Label's numbers, any other is an std::invalid_argument too.
void addScores(const Scan& scan, const std::vector<std::uint16_t>& truth,
               const std::vector<Label>& found, float max_range_m, Scores& scores);

}  // namespace hagen
