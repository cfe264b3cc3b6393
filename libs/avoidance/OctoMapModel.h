#pragma once
#include <hagen/avoidance/WorldModel.h>
#include <hagen/mapping/ScanMap.h>
#include <array>
#include <cstdint>
#include <set>

#include "VoxelTree.h"

namespace hagen::avoidance {

/// An OctoMap within the bounds, and a k-d tree of its occupied voxels, updated by the map's change
/// detection.
class OctoMapModel : public WorldModel {
 public:
    OctoMapModel(const mapping::ScanMapOptions& options, const Eigen::AlignedBox3f& bounds_m);

    void update(const mapping::MappedScan& scan) override;
    float clearance_m(const Eigen::Vector3f& point_m) const override;
    float clearanceWithin_m(const Eigen::Vector3f& point_m, float limit_m) const override;
    bool isKnown(const Eigen::Vector3f& point_m) const override;
    std::size_t bytes() const override;
    Obstacles obstacles() const override;

 private:
    using Key = std::array<std::uint16_t, 3>;
    void noteChanges();

    mapping::ScanMap map_;
    std::set<Key> occupied_;  ///< ordered, so that no hash decides the order
    VoxelTree obstacles_;
};

}  // namespace hagen::avoidance
