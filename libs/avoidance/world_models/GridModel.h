#pragma once
#include <hagen/avoidance/WorldModel.h>
#include <memory>

#include "avoidance/world_models/VoxelTree.h"

namespace mrpt::maps {
class COccupancyGridMap3D;
}

namespace hagen::avoidance {

/// MRPT's COccupancyGridMap3D of all points within the bounds, with a k-d tree of its occupied
/// cells.
class GridModel : public WorldModel {
 public:
    /// Returns beyond `max_range_m` only clear cells, up to this range.
    GridModel(float edge_m, const Eigen::AlignedBox3f& bounds_m, float max_range_m);
    ~GridModel() override;

    void update(const observations::MappedScan& scan) override;
    float clearanceWithin_m(const Eigen::Vector3f& point_m, float limit_m) const override;
    bool isKnown(const Eigen::Vector3f& point_m) const override;
    std::size_t bytes() const override;
    Obstacles obstacles() const override;

 private:
    std::vector<Eigen::Vector3f> occupied_m() const;

    float edge_m_, max_range_m_;
    Eigen::Array3f corner_m_;  ///< minimum corner
    Eigen::Array3i size_;      ///< size in cells
    std::unique_ptr<mrpt::maps::COccupancyGridMap3D> map_;
    VoxelTree obstacles_;
};

}  // namespace hagen::avoidance
