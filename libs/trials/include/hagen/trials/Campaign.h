#pragma once
#include <hagen/trials/CampaignFolder.h>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace hagen::trials {

/// The campaign was told to stop. Finished runs are kept.
struct CampaignStopped : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The program that flies a share of the runs in a process of its own. It is started with these
/// arguments (the first is the program's name), then
///
///     --parent PID --profile FILE --journal FILE KEY...
///
/// calls endWithParent(), hands the rest to flyRuns(), and ends with exit status 0, also when a
/// signal told it to stop. If it fails, it writes the reason to stderr and ends with another
/// status.
struct WorkerCommand {
    std::string program;
    std::vector<std::string> arguments;
};

struct CampaignOptions {
    int jobs = 1;                                                     ///< processes at a time
    WorkerCommand worker;                                             ///< starts one of them
    std::function<bool()> keep_going;                                 ///< asked often; false: stop
    std::function<void(std::size_t done, std::size_t all)> progress;  ///< a few times per second
};

/// Flies what is not in the folder yet, and finishes the folder. The result does not depend on the
/// number of processes. Returns the number of runs flown.
/// Throws CampaignStopped; std::runtime_error if a process failed or was killed, naming the run it
/// flew. The finished runs stay in the folder, and the same call continues from there.
std::size_t flyCampaign(const std::vector<CourseFlights>& flights, const CampaignOptions& options,
                        CampaignFolder& folder);

}  // namespace hagen::trials
