#pragma once
#include <hagen/avoidance/RunTable.h>
#include <hagen/avoidance/Trial.h>

namespace hagen::avoidance {

/// A run of a table, flown again.
struct Reflown {
    avoidance::Course course;
    avoidance::TrialResult result;
    bool is_same;  ///< every field of the row is the same
};

/// Flies a run again with its setup. Throws like makeCourse() and runTrial().
Reflown flyAgain(const avoidance::Run& run, const avoidance::LatencyProfile& profile,
                 const avoidance::TrialListener& listener);

}  // namespace hagen::avoidance
