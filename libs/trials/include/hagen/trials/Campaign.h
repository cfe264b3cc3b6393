#pragma once
#include <hagen/trials/CampaignFolder.h>
#include <functional>
#include <stdexcept>

namespace hagen::trials {

/// The campaign was told to stop. What was finished is kept.
struct CampaignStopped : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct CampaignOptions {
    int jobs = 1;                                                     ///< processes, one a core
    std::function<bool()> keep_going;                                 ///< asked often; false: stop
    std::function<void(std::size_t done, std::size_t all)> progress;  ///< a few times a second
};

/// Flies what is not in the folder yet, and finishes the folder. Courses are dealt out to
/// processes as these become free; what comes out does not depend on which flew what. Returns how
/// many runs were flown.
/// Throws CampaignStopped; std::runtime_error where a process failed or was killed, naming what it
/// flew. The folder keeps the finished runs then, and the same call goes on from there.
std::size_t flyCampaign(const std::vector<CourseFlights>& flights, const LatencyProfile& profile,
                        const CampaignOptions& options, CampaignFolder& folder);

}  // namespace hagen::trials
