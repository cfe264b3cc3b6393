#pragma once
#include <hagen/trials/CampaignPlan.h>
#include <filesystem>
#include <string>
#include <vector>

namespace hagen::trials {

/// campaign.json: what holds for all runs of a folder, and which plans were flown into it.
struct CampaignFile {
    std::string settings_hash;
    std::vector<std::string> plans;  ///< as JSON, sorted, each once
};

/// The plan as JSON, on one line.
std::string textOf(const CampaignPlan& plan);

/// Throws std::runtime_error, naming the file.
CampaignFile readCampaignFile(const std::filesystem::path& folder);
/// Its text, with what else holds for all runs: version, profile, vehicle and filter.
std::string textOf(const CampaignFile& campaign, const LatencyProfile& profile);

/// The plans that a folder's campaign.json notes. Throws std::runtime_error, naming the file.
std::vector<CampaignPlan> readPlans(const std::filesystem::path& folder);

}  // namespace hagen::trials
