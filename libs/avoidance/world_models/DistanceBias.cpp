#include <hagen/avoidance/DistanceBias.h>

#include <map>
#include <stdexcept>

namespace hagen::avoidance {
namespace {

// Printed by `octomap-compare distances --seeds 0-29`: means over walls and poles with equal
// weight. Measure again when a model, or what it takes in, changes. Checked on seeds 100-119.
const std::map<std::string, float>& biases_m() {
    static const std::map<std::string, float> biases_m{
        {"W-RoI", -0.009f},          {"W-RoI+motion", -0.009f}, {"W-Full", -0.009f},
        {"W-Full+motion", -0.009f},  {"O-Full-0.2", -0.150f},   {"O-Full-0.4", -0.272f},
        {"O-RoI-0.2", -0.152f},      {"O-RoI-0.4", -0.273f},    {"O-RoI+rays-0.2", -0.150f},
        {"O-RoI+rays-0.4", -0.272f}, {"G-Full", -0.139f},       {"G-Full+motion", -0.139f},
        {"R-Full-0.1", -0.083f},     {"R-Full-0.2", -0.150f},   {"R-Full-0.2+motion", -0.150f},
        {"D-Full", -0.161f},
    };
    return biases_m;
}

}  // namespace

float distanceBias_m(const std::string& model) {
    const auto found = biases_m().find(model);
    if (found != biases_m().end()) return found->second;
    throw std::invalid_argument("the distances of '" + model +
                                "' were not measured; add it to DistanceBias.cpp as "
                                "'octomap-compare distances' prints it");
}

}  // namespace hagen::avoidance
