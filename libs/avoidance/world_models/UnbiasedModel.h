#pragma once
#include <hagen/avoidance/WorldModel.h>

namespace hagen::avoidance {

/// A model whose clearances are, by `bias_m` on average, larger than the true ones: subtracts it.
/// With a negative bias, clearances grow; none exceeds kReach_m, and none falls below 0.
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
