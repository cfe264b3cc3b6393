#pragma once
#include <hagen/avoidance/WorldModel.h>
#include <cstdint>
#include <vector>

#include "avoidance/world_models/DepthImage.h"
#include "avoidance/world_models/RollingBox.h"
#include "avoidance/world_models/VoxelSet.h"

namespace hagen::avoidance {

/// A map that casts no rays, after D-Map (Cai et al. 2023, arXiv 2307.08493), in a box that moves
/// with the vehicle.
///
/// From the paper: a scan becomes a depth image, into which a cell of space is projected: cells
/// nearer than its depths are free, farther ones remain unknown. The map stores unknown space in a
/// tree, from which known cells are removed, and occupied voxels separately. The tree is descended
/// only where it contains unknown cells, and not into cells behind all depths of their part of the
/// image, or without rays.
///
/// Not from the paper: the box; three levels of 64 children, in bit masks, instead of an octree.
/// Free space is decided voxel by voxel, because the rows of a VLP-16 are 2 degrees apart: a large
/// cell has gaps between them. A voxel is regarded as seen if a row passes within a degree of it.
/// Occupied voxels, which are final in the paper, are checked against each image: if all depths
/// around a voxel lie beyond it, its log odds fall as in OctoMap, so that moving objects disappear.
class DepthImageModel : public WorldModel {
 public:
    DepthImageModel(float edge_m, const FlightPace& pace);

    void update(const observations::MappedScan& scan) override;
    float clearanceWithin_m(const Eigen::Vector3f& point_m, float limit_m) const override;
    bool isKnown(const Eigen::Vector3f& point_m) const override;
    std::size_t bytes() const override;
    Obstacles obstacles() const override;

 private:
    void addHits(const observations::MappedScan& scan);
    void clearSeenThrough(const Eigen::Vector3f& origin_m);
    void removeKnown(const Eigen::Vector3f& origin_m);
    /// A cell as seen by the sensor: distances of its nearest voxel from the sensor and from the
    /// vertical axis through it, and half that voxel's extent in the image.
    struct Outline {
        Eigen::Vector3f to_middle_m;
        float spread_m;  ///< distance from the cell's centre to the farthest voxel's centre
        float min_away_m, min_around_m, half_columns, half_rows;
    };
    Eigen::Vector3f cornerOf(const Eigen::Array3i& first, const Eigen::Vector3f& origin_m) const;
    Outline outlineOf(const Eigen::Vector3f& to_corner_m, int voxels) const;
    std::uint64_t nearerVoxels(const Eigen::Vector3f& to_corner_m, std::uint64_t voxels,
                               float min_half_rows) const;
    bool mayHaveFree(const Eigen::Vector3f& to_corner_m, int voxels) const;

    float max_range_m_;
    RollingBox box_;
    DepthImage image_;
    VoxelSet unknown_, occupied_;
    std::vector<std::int8_t> log_odds_;  ///< per voxel; valid if occupied
    std::vector<std::uint64_t> hit_;     ///< voxels hit in the scan, one mask per block
    std::vector<std::uint32_t> hits_;    ///< blocks hit in the scan
};

}  // namespace hagen::avoidance
