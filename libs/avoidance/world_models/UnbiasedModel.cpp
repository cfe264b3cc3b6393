#include <hagen/avoidance/UnbiasedModel.h>
#include <map>
#include <stdexcept>

namespace hagen::avoidance {
namespace {

// Measured by tests/flights/DistanceBias_test.cpp on seeds 0-29: means over walls and poles with
// equal weight. Measure again when a model or its input changes. Checked on seeds 100-119.
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
                                "' were not measured; see DistanceBias_test.cpp");
}

float UnbiasedModel::clearance_m(const Eigen::Vector3f& point_m) const {
    return std::clamp(model_->clearance_m(point_m) - bias_m_, 0.0f, kReach_m);
}

float UnbiasedModel::clearanceWithin_m(const Eigen::Vector3f& point_m, float limit_m) const {
    const float limit_of_model_m = limit_m + bias_m_;
    if (limit_of_model_m <= 0) return limit_m;  // even next to an obstacle it is more
    return std::clamp(model_->clearanceWithin_m(point_m, limit_of_model_m) - bias_m_, 0.0f,
                      std::min(limit_m, kReach_m));
}

WorldModel::ClearanceQuery UnbiasedModel::clearanceQuery(const Eigen::AlignedBox3f& box_m,
                                                         float limit_m) const {
    const float limit_of_model_m = limit_m + bias_m_;
    if (limit_of_model_m <= 0) return WorldModel::clearanceQuery(box_m, limit_m);
    return [=, biased_m = model_->clearanceQuery(box_m, limit_of_model_m)](
               const Eigen::Vector3f& point_m) {
        return std::clamp(biased_m(point_m) - bias_m_, 0.0f, std::min(limit_m, kReach_m));
    };
}

float UnbiasedModel::clearanceAfter_m(const Eigen::Vector3f& point_m, double after_s) const {
    return std::clamp(model_->clearanceAfter_m(point_m, after_s) - bias_m_, 0.0f, kReach_m);
}

}  // namespace hagen::avoidance
