#pragma once
#include <hagen/avoidance/WorldModel.h>
#include <array>
#include <deque>
#include <memory>

namespace hagen {

/// No map: the points of the last scans, each scan in a tree of its own, so that a new one costs
/// one small tree and forgets the oldest.
class WindowModel : public WorldModel {
 public:
    static constexpr std::size_t kScans = 10;
    static constexpr float kRadius_m = 15;  ///< points farther from their scan's origin are left

    explicit WindowModel(bool roi_only);
    ~WindowModel() override;

    void update(const MappedScan& scan) override;
    float clearance_m(const Eigen::Vector3f& point_m) const override;
    bool isKnown(const Eigen::Vector3f& point_m) const override;
    std::size_t bytes() const override;
    Obstacles obstacles() const override;

 private:
    struct PastScan;
    bool roi_only_;
    std::deque<std::unique_ptr<PastScan>> scans_;  ///< newest first
};

}  // namespace hagen
