#pragma once
#include <hagen/trials/RunTable.h>
#include <hagen/trials/Trial.h>

namespace hagen::replays {

/// A run of a table, flown once more.
struct Reflown {
    trials::Course course;
    trials::TrialResult result;
    bool is_same;  ///< every figure of the row came out again
};

/// Flies the course of a run as it was flown. Throws as makeCourse() and runTrial() do.
Reflown flyAgain(const trials::Run& run, const trials::LatencyProfile& profile,
                 const trials::TrialListener& listener);

}  // namespace hagen::replays
