#pragma once
#include <hagen/trials/Condition.h>
#include <hagen/trials/Measured.h>
#include <filesystem>
#include <vector>

namespace hagen::trials {

/// A contender under a condition with planned runs that are not done yet.
struct Shortfall {
    Condition condition;
    Contender contender;
    int flown, planned;
};

/// The runs of a campaign folder, finished or not.
struct FlownRuns {
    std::vector<Run> runs;         ///< finished runs, sorted, including those in journals
    MeasuredByContender measured;  ///< cost of the runs; empty if not measured
    int planned = 0;               ///< according to campaign.json; 0 without it
    int missing = 0;               ///< planned runs that are not done
    std::vector<Shortfall> shortfalls;
};

/// Reads a folder, also while its campaign is running. Throws std::runtime_error, naming file and
/// line, if one cannot be read or the folder contains no campaign.
FlownRuns readFlownRuns(const std::filesystem::path& folder);

}  // namespace hagen::trials
