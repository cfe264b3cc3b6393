#include "avoidance/flights/TrialLatencies.h"

#include "avoidance/flights/Streams.h"

namespace hagen::avoidance {

std::vector<std::string> stagesOf(const TrialSetup& setup) {
    std::vector<std::string> stages;
    if (needsLabels(setup.model)) stages.push_back("filter");
    const std::string prefix = setup.model + "/";
    for (const std::string& part :
         {std::string("update"), setup.guidance, setup.guidance + "+" + setup.planner}) {
        stages.push_back(prefix + part);
    }
    return stages;
}

TrialLatencies::TrialLatencies(const Course& course, const TrialSetup& setup,
                               const LatencyProfile& profile)
    : profile_(profile), scale_(setup.latency_scale) {
    // Streams are numbered from the end, so that models with and without the filter share them.
    const std::vector<std::string> names = stagesOf(setup);
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::uint64_t stream = streams::kLatency + (names.size() - i);
        stages_.push_back({names[i], simulation::Random(course.seed, stream)});
    }
}

double TrialLatencies::draw_s() {
    double sum_ms = 0;
    for (Stage& stage : stages_) sum_ms += profile_.draw_ms(stage.name, stage.random);
    return 1e-3 * scale_ * sum_ms;
}

double TrialLatencies::median_s() const {
    double sum_ms = 0;
    for (const Stage& stage : stages_) sum_ms += profile_.median_ms(stage.name);
    return 1e-3 * scale_ * sum_ms;
}

}  // namespace hagen::avoidance
