#pragma once
#include <hagen/evaluation/Baselines.h>
#include <hagen/scan/Label.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <vector>

namespace hagen::evaluation {

/// The Point Cloud Library's obstacle detection, as in its tutorial "Euclidean Cluster Extraction":
/// voxel grid, removal of the ground plane by RANSAC, Euclidean clusters of the remaining points.
/// The tutorial's lengths suit a table top; docs/baselines.md explains the lengths used here.
struct PclEuclideanOptions {
    float leaf_m = 0.2f;               ///< edge of a voxel
    float plane_distance_m = 0.2f;     ///< maximum distance of points from the plane
    int plane_iterations = 100;        ///< RANSAC iterations, from the tutorial
    float plane_tilt_deg = 30.0f;      ///< maximum slope of the ground in the sensor's frame
    float cluster_tolerance_m = 0.7f;  ///< maximum distance between neighbours in a cluster
    int min_cluster_points = 10;       ///< smaller clusters (in voxels) are not obstacles
    float zone_m = 20.0f;              ///< farther returns are ROU and not processed
};

/// Returns one label per return: RoI if the return's voxel is in a cluster; ROU for returns of the
/// plane, of clusters that are too small, and farther than `zone_m`; Unclassified outside the
/// sensor's range limits. RANSAC draws the same samples each time (PCL's fixed seed), so labels are
/// reproducible. Without a plane, everything is clustered. Throws std::invalid_argument if a length
/// or count is not positive, or if the zone contains more voxels than PCL can number.
std::vector<Label> pclEuclideanLabels(const Scan& scan, const SensorModel& sensor,
                                      const PclEuclideanOptions& options = {});

/// Baselines to append to baselines(): with the usual parameters, and tuned on labelled scans.
std::vector<Baseline> pclBaselines(float zone_m);

}  // namespace hagen::evaluation
