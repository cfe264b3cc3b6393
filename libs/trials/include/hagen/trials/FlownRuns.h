#pragma once
#include <hagen/trials/Condition.h>
#include <hagen/trials/Measured.h>
#include <filesystem>
#include <vector>

namespace hagen::trials {

/// Planned runs of a contender under a condition that are not all there.
struct Shortfall {
    Condition condition;
    Contender contender;
    int flown, planned;
};

/// What a folder of `closedloop` holds of its campaign.
struct FlownRuns {
    std::vector<Run> runs;     ///< finished ones, sorted; those still in journals, too
    MeasuredByModel measured;  ///< what they cost; empty where nobody measured
    int planned = 0;           ///< by campaign.json; 0 where there is none
    int missing = 0;           ///< of the planned ones
    std::vector<Shortfall> shortfalls;
};

/// Reads a folder, also while it is being flown into. Throws std::runtime_error, naming file and
/// line, for what cannot be read, and where the folder holds no campaign.
FlownRuns readFlownRuns(const std::filesystem::path& folder);

}  // namespace hagen::trials
