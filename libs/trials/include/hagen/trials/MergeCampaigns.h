#pragma once
#include <cstddef>
#include <filesystem>
#include <vector>

namespace hagen::trials {

/// Joins the folders of shards into a new folder, or one of the same settings. Runs that several
/// folders have are taken once. Returns the number of runs. Throws std::runtime_error if a folder
/// holds no campaign, has other settings, or contradicts another.
std::size_t mergeCampaigns(const std::vector<std::filesystem::path>& folders,
                           const std::filesystem::path& into, bool overwrite);

}  // namespace hagen::trials
