#include "avoidance/world_models/UnbiasedModel.h"

namespace hagen::avoidance {

float UnbiasedModel::clearance_m(const Eigen::Vector3f& point_m) const {
    return std::clamp(model_->clearance_m(point_m) - bias_m_, 0.0f, kReach_m);
}

float UnbiasedModel::clearanceWithin_m(const Eigen::Vector3f& point_m, float limit_m) const {
    const float limit_of_model_m = limit_m + bias_m_;
    if (limit_of_model_m <= 0) return limit_m;  // the bias alone exceeds the limit
    return std::clamp(model_->clearanceWithin_m(point_m, limit_of_model_m) - bias_m_, 0.0f,
                      std::min(limit_m, kReach_m));
}

float UnbiasedModel::clearanceAfter_m(const Eigen::Vector3f& point_m, double after_s) const {
    return std::clamp(model_->clearanceAfter_m(point_m, after_s) - bias_m_, 0.0f, kReach_m);
}

}  // namespace hagen::avoidance
