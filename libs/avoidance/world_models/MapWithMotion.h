#pragma once
#include <memory>
#include "avoidance/world_models/Movers.h"

namespace hagen::avoidance {

/// A map of what stands, and the obstacles that move where they will be (Movers). What moves is not
/// entered into the map, but for the rays up to it; what was entered before it was known to move
/// stays until rays clear it.
class MapWithMotion : public WorldModel {
 public:
    MapWithMotion(std::unique_ptr<WorldModel> map, float farthest_m)
        : map_(std::move(map)), movers_(farthest_m) {}

    void update(const observations::MappedScan& scan) override;
    float clearance_m(const Eigen::Vector3f& point_m) const override;
    float clearanceWithin_m(const Eigen::Vector3f& point_m, float limit_m) const override;
    ClearanceQuery clearanceQuery(const Eigen::AlignedBox3f& box_m, float limit_m) const override;
    float clearanceAfter_m(const Eigen::Vector3f& point_m, double after_s) const override;
    float fastest_m_s() const override { return movers_.fastest_m_s(); }
    bool isKnown(const Eigen::Vector3f& point_m) const override { return map_->isKnown(point_m); }
    std::size_t bytes() const override { return map_->bytes() + movers_.bytes(); }
    /// Points of movers are drawn as voxels, too.
    Obstacles obstacles() const override;

 private:
    std::unique_ptr<WorldModel> map_;
    Movers movers_;
};

}  // namespace hagen::avoidance
