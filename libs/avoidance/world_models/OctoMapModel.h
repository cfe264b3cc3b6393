#pragma once
#include <hagen/avoidance/WorldModel.h>
#include <hagen/mrpt/ScanMap.h>
#include <array>
#include <cstdint>
#include <set>

#include "avoidance/world_models/VoxelTree.h"

namespace hagen::avoidance {

/// An OctoMap within the bounds, and a k-d tree of its occupied voxels, updated by the map's change
/// detection.
class OctoMapModel : public WorldModel {
 public:
    OctoMapModel(const observations::ScanMapOptions& options, const Eigen::AlignedBox3f& bounds_m);

    void update(const observations::MappedScan& scan) override;
    float clearanceWithin_m(const Eigen::Vector3f& point_m, float limit_m) const override;
    bool isKnown(const Eigen::Vector3f& point_m) const override;
    std::size_t bytes() const override;
    Obstacles obstacles() const override;

 private:
    using Key = std::array<std::uint16_t, 3>;
    void noteChanges();

    observations::ScanMap map_;
    std::set<Key> occupied_;  ///< ordered, so that results do not depend on a hash
    VoxelTree obstacles_;
};

}  // namespace hagen::avoidance
