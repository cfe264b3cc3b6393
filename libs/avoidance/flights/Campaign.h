#pragma once
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <vector>
#include "avoidance/flights/CampaignPlan.h"
#include "avoidance/flights/RunTable.h"

namespace hagen::avoidance {

/// The campaign was interrupted. Finished runs are kept.
struct CampaignStopped : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct CampaignOptions {
    int jobs = 1;                      ///< threads
    bool overwrites = false;           ///< discards the runs of an older campaign in the folder
    std::function<bool()> keep_going;  ///< called often, from any thread; false stops
    std::function<void(std::size_t done, std::size_t all)> progress;  ///< after each run
};

/// Flies the missing runs of a campaign in its folder, which contains
///
///     campaign.json  settings hash, version and latency profile of all runs
///     profile.json   latency profile that runs draw from
///     runs.csv       a row for each run, appended when it ends; sorted at the end of the campaign
///
/// Returns all runs of the folder, sorted. runs.csv does not depend on the number of jobs. Throws
/// CampaignStopped, and std::runtime_error naming the path if the folder contains other files or
/// runs with other settings, or cannot be written. Another call resumes with the next run.
std::vector<Run> flyCampaign(const std::vector<CourseFlights>& flights,
                             const LatencyProfile& profile, const std::filesystem::path& folder,
                             const CampaignOptions& options);

}  // namespace hagen::avoidance
