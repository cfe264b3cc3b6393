#pragma once
#include "avoidance/world_models/Movers.h"
#include "avoidance/world_models/WindowModel.h"

namespace hagen::avoidance {

/// A window in which obstacles that move are where they will be (Movers). Their older points, where
/// they no longer are, do not count while they are followed and move; then they do again, for where
/// they went is not known. What does not move, or not certainly, is as in the window.
class MotionWindow : public WorldModel {
 public:
    MotionWindow(bool roi_only, WindowSize size)
        : window_(roi_only, size), movers_(size.radius_m) {}

    void update(const observations::MappedScan& scan) override;
    float clearance_m(const Eigen::Vector3f& point_m) const override;
    float clearanceWithin_m(const Eigen::Vector3f& point_m, float limit_m) const override;
    ClearanceQuery clearanceQuery(const Eigen::AlignedBox3f& box_m, float limit_m) const override;
    float clearanceAfter_m(const Eigen::Vector3f& point_m, double after_s) const override;
    float fastest_m_s() const override { return movers_.fastest_m_s(); }
    bool isKnown(const Eigen::Vector3f& point_m) const override { return window_.isKnown(point_m); }
    std::size_t bytes() const override { return window_.bytes() + movers_.bytes(); }
    Obstacles obstacles() const override;

 private:
    WindowModel window_;
    Movers movers_;
};

}  // namespace hagen::avoidance
