#include <hagen/trials/CampaignFolder.h>
#include <hagen/trials/MergeCampaigns.h>
#include <stdexcept>

namespace hagen::trials {

namespace fs = std::filesystem;

std::size_t mergeCampaigns(const std::vector<fs::path>& folders, const fs::path& into,
                           bool overwrite) {
    if (folders.empty()) throw std::invalid_argument("no folder to merge is given");
    for (const fs::path& folder : folders) {
        if (!fs::exists(folder / "campaign.json")) {
            throw std::runtime_error(folder.string() + ": contains no campaign (campaign.json)");
        }
        if (fs::exists(into) && fs::equivalent(folder, into)) {
            throw std::runtime_error(folder.string() + ": is also the output");
        }
    }
    const auto profileOf = [](const fs::path& folder) {
        return readLatencyProfile(folder / "profile.json");
    };
    CampaignFolder merged(into, profileOf(folders.front()), overwrite);
    for (const fs::path& folder : folders) {
        merged.add(CampaignFolder(folder, profileOf(folder), false));
    }
    merged.finish();
    return merged.size();
}

}  // namespace hagen::trials
