#pragma once
#include <hagen/avoidance/WorldModel.h>
#include <deque>
#include <memory>

namespace hagen::avoidance {

/// No map: the points of the last scans, thinned to one a cube of 10 cm each, three scans in a
/// tree, so that a new one costs a small tree, questions go through few, and the oldest scan is
/// forgotten as it is. Unthinned, a wall nearby would be most of a scan, far closer than it is
/// measured.
class WindowModel : public WorldModel {
 public:
    static constexpr std::size_t kScans = 10;
    static constexpr float kRadius_m = 15;  ///< points farther from their scan's origin are left
    static constexpr float kThinning_m = 0.1f;

    explicit WindowModel(bool roi_only);
    ~WindowModel() override;

    void update(const mapping::MappedScan& scan) override;
    float clearance_m(const Eigen::Vector3f& point_m) const override;
    float clearanceWithin_m(const Eigen::Vector3f& point_m, float most_m) const override;
    bool isKnown(const Eigen::Vector3f& point_m) const override;
    std::size_t bytes() const override;
    Obstacles obstacles() const override;

 private:
    struct PastScans;
    void forgetOldest();

    bool roi_only_;
    std::size_t scans_ = 0;
    std::deque<std::unique_ptr<PastScans>> past_;  ///< newest first
};

}  // namespace hagen::avoidance
