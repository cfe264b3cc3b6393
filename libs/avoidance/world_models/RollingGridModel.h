#pragma once
#include <hagen/avoidance/WorldModel.h>
#include <cstdint>
#include <vector>

#include "avoidance/world_models/RollingBox.h"
#include "avoidance/world_models/VoxelSet.h"

namespace hagen::avoidance {

/// An occupancy grid in a box that moves with the vehicle, so that memory is constant, as in
/// ROG-Map (Ren et al. 2023, arXiv 2302.14819): circular indexing, log odds by ray traversal.
/// Content that leaves the box is lost.
///
/// Log odds and their limits are OctoMap's. A voxel is updated once per scan: occupied if it
/// contains a return, otherwise free if a ray passes through. Rays that end in the same voxel are
/// merged into one ray to its centre. Returns beyond the range of a window (15 m at 4 m/s) only
/// clear voxels, up to that range or the border of the box.
///
/// ROG-Map keeps an inflated copy of the map for one vehicle radius, but these planners query
/// distances. Only a bit per occupied voxel is updated incrementally; VoxelSet computes the exact
/// distance from the bits.
class RollingGridModel : public WorldModel {
 public:
    RollingGridModel(float edge_m, const FlightPace& pace);

    void update(const observations::MappedScan& scan) override;
    float clearanceWithin_m(const Eigen::Vector3f& point_m, float limit_m) const override;
    bool isKnown(const Eigen::Vector3f& point_m) const override;
    std::size_t bytes() const override;
    Obstacles obstacles() const override;

 private:
    void markEnds(const observations::MappedScan& scan);
    void trace(const Eigen::Array3f& origin, const Eigen::Array3i& end);
    void apply();

    float max_range_m_;
    RollingBox box_;
    std::vector<std::int8_t> log_odds_;  ///< per voxel, see RollingGridModel.cpp
    VoxelSet occupied_;
    std::vector<std::int8_t> marks_, is_marked_;  ///< of the scan, per voxel and block
    std::vector<std::uint32_t> hits_;             ///< voxels of the scan's returns
    std::vector<Eigen::Array3i> ends_;            ///< ends of the scan's rays, in voxels of the box
};

}  // namespace hagen::avoidance
