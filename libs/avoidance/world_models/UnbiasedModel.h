#pragma once
#include <hagen/avoidance/WorldModel.h>

namespace hagen::avoidance {

/// Subtracts the mean error `bias_m` from the clearances of a model. With a negative bias,
/// clearances grow. Results are limited to [0, kReach_m].
class UnbiasedModel : public WorldModel {
 public:
    UnbiasedModel(std::unique_ptr<WorldModel> model, float bias_m)
        : model_(std::move(model)), bias_m_(bias_m) {}

    void update(const observations::MappedScan& scan) override { model_->update(scan); }
    float clearance_m(const Eigen::Vector3f& point_m) const override;
    float clearanceWithin_m(const Eigen::Vector3f& point_m, float limit_m) const override;
    float clearanceAfter_m(const Eigen::Vector3f& point_m, double after_s) const override;
    float fastest_m_s() const override { return model_->fastest_m_s(); }
    bool isKnown(const Eigen::Vector3f& point_m) const override { return model_->isKnown(point_m); }
    std::size_t bytes() const override { return model_->bytes(); }
    Obstacles obstacles() const override { return model_->obstacles(); }

 private:
    std::unique_ptr<WorldModel> model_;
    float bias_m_;
};

}  // namespace hagen::avoidance
