#pragma once
#include <hagen/trials/RunTable.h>
#include <hagen/trials/Trial.h>

namespace hagen::replays {

/// A run of a table, flown again.
struct Reflown {
    trials::Course course;
    trials::TrialResult result;
    bool is_same;  ///< every field of the row is the same
};

/// Flies a run again with its setup. Throws like makeCourse() and runTrial().
Reflown flyAgain(const trials::Run& run, const trials::LatencyProfile& profile,
                 const trials::TrialListener& listener);

}  // namespace hagen::replays
