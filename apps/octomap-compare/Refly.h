#pragma once
#include <hagen/trials/RunTable.h>
#include <hagen/trials/Trial.h>

namespace hagen {

/// A run of a table, flown once more.
struct Reflown {
    Course course;
    TrialResult result;
    bool is_same;  ///< every figure of the row came out again
};

/// Flies the course of a run as it was flown. Throws as makeCourse() and runTrial() do.
Reflown flyAgain(const Run& run, const LatencyProfile& profile, const TrialListener& listener);

}  // namespace hagen
