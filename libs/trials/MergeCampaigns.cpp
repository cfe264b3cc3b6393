#include <hagen/trials/CampaignFile.h>
#include <hagen/trials/CampaignFolder.h>
#include <hagen/trials/MergeCampaigns.h>
#include <hagen/trials/SettingsHash.h>
#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

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
    // What does not belong together is found before the output is touched.
    std::vector<CampaignFolder> parts;
    for (const fs::path& folder : folders) {
        const bool is_known = std::any_of(parts.begin(), parts.end(), [&](const auto& part) {
            return fs::equivalent(part.path(), folder);
        });
        if (is_known) continue;
        if (readCampaignFile(folder).settings_hash != hashOfSettings(profileOf(folder))) {
            throw std::runtime_error(
                folder.string() +
                ": was flown by another version of this program (filter, vehicle, sensor or "
                "guidance differ), or its profile.json was changed; merge it with that version");
        }
        CampaignFolder part(folder, profileOf(folder), false);
        for (const CampaignFolder& earlier : parts) earlier.checkJoins(part);
        parts.push_back(std::move(part));
    }
    CampaignFolder merged(into, profileOf(folders.front()), overwrite);
    for (const CampaignFolder& part : parts) merged.checkJoins(part);
    for (const CampaignFolder& part : parts) merged.add(part);
    merged.finish();
    return merged.size();
}

}  // namespace hagen::trials
