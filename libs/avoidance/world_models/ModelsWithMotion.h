#pragma once
#include "avoidance/world_models/Movers.h"
#include "avoidance/world_models/WindowModel.h"

namespace hagen::avoidance {

/// A model of static obstacles, combined with predicted moving obstacles (Movers).
class ModelWithMotion : public WorldModel {
 public:
    float clearanceWithin_m(const Eigen::Vector3f& point_m, float limit_m) const override;
    float clearanceAfter_m(const Eigen::Vector3f& point_m, double after_s) const override;
    float fastest_m_s() const override { return movers_.fastest_m_s(); }
    bool isKnown(const Eigen::Vector3f& point_m) const override { return still_->isKnown(point_m); }
    std::size_t bytes() const override { return still_->bytes() + movers_.bytes(); }
    /// Includes the points of movers, drawn as voxels if the model has voxels.
    Obstacles obstacles() const override;

 protected:
    ModelWithMotion(std::unique_ptr<WorldModel> still, float farthest_m)
        : still_(std::move(still)), movers_(farthest_m) {}

    std::unique_ptr<WorldModel> still_;
    Movers movers_;
};

/// A window without the points of moving obstacles while these are tracked. When a track ends, its
/// points are restored, because the position of the obstacle is unknown.
class WindowWithMotion : public ModelWithMotion {
 public:
    WindowWithMotion(bool roi_only, WindowSize size)
        : ModelWithMotion(std::make_unique<WindowModel>(roi_only, size), size.radius_m) {}

    void update(const observations::MappedScan& scan) override;
};

/// A map without the returns of moving obstacles, except for the rays up to them. Cells entered
/// before an obstacle was known to move stay until rays clear them.
class MapWithMotion : public ModelWithMotion {
 public:
    MapWithMotion(std::unique_ptr<WorldModel> map, float farthest_m)
        : ModelWithMotion(std::move(map), farthest_m) {}

    void update(const observations::MappedScan& scan) override;
};

}  // namespace hagen::avoidance
