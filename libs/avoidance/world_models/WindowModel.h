#pragma once
#include <hagen/avoidance/WindowSize.h>
#include <hagen/avoidance/WorldModel.h>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "avoidance/world_models/SeenDirections.h"

namespace hagen::avoidance {

/// No map: the points of the last scans, each thinned to one point per 10 cm cube. Three scans
/// share a k-d tree, so that a new scan needs only a small tree and a query visits few trees.
/// Sectors of a turn are first collected in a separate tree. Without thinning, a nearby wall would
/// fill a scan with points much denser than the measurement noise.
///
/// An isolated return may be dust or rain, or the first of a thin object. It is ignored until
/// another return is within 5 % of its range (at least 15 cm): in its own scan, in an earlier one
/// of the window or in a later one. (Like dynamic radius outlier removal within a scan: Charron et
/// al., "De-noising of Lidar Point Clouds Corrupted by Snowfall", CRV 2018.)
class WindowModel : public WorldModel {
 public:
    static constexpr float kThinning_m = 0.1f;

    WindowModel(bool roi_only, WindowSize size);
    ~WindowModel() override;

    void update(const observations::MappedScan& scan) override;
    /// Like update(scan), but with the scan's view and the track number of each obstacle, by
    /// obstacle number (0: none).
    void update(const observations::MappedScan& scan, std::shared_ptr<const View> view,
                const std::vector<std::uint32_t>& track_of_obstacle);
    /// Ignores points of these tracks until the next call.
    void hide(const std::vector<std::uint32_t>& tracks);
    float clearanceWithin_m(const Eigen::Vector3f& point_m, float limit_m) const override;
    bool isKnown(const Eigen::Vector3f& point_m) const override;
    std::size_t bytes() const override;
    Obstacles obstacles() const override;

 private:
    struct PastScans;
    void gather(std::unique_ptr<PastScans> newest);
    void confirmIsolated();
    void forgetOldest();

    bool roi_only_;
    WindowSize size_;
    double turns_ = 0;                             ///< turns in the window
    std::deque<std::unique_ptr<PastScans>> past_;  ///< newest first
};

}  // namespace hagen::avoidance
