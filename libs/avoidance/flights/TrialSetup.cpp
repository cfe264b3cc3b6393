#include <hagen/avoidance/TrialSetup.h>
#include <hagen/avoidance/WorldModel.h>

namespace hagen::avoidance {

std::vector<std::string> stagesOf(const TrialSetup& setup) {
    std::vector<std::string> stages;
    if (avoidance::needsLabels(setup.model)) stages.push_back("filter");
    const std::string prefix = setup.model + "/";
    for (const std::string& part :
         {std::string("update"), setup.guidance, setup.guidance + "+" + setup.planner}) {
        stages.push_back(prefix + part);
    }
    return stages;
}

}  // namespace hagen::avoidance
