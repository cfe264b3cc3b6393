#pragma once
#include <hagen/evaluation/Baselines.h>
#include <hagen/range_image/Label.h>
#include <hagen/range_image/Scan.h>
#include <hagen/range_image/SensorModel.h>
#include <vector>

namespace hagen::evaluation {

/// The Point Cloud Library's own way to obstacles: voxel grid, a plane by RANSAC taken out, the
/// rest into Euclidean clusters, as in its tutorial "Euclidean Cluster Extraction". The tutorial's
/// lengths are those of a table top; docs/baselines.md says where these come from.
struct PclEuclideanOptions {
    float leaf_m = 0.2f;               ///< edge of a voxel
    float plane_distance_m = 0.2f;     ///< the plane's points lie closer to it than this
    int plane_iterations = 100;        ///< RANSAC; the tutorial's
    float plane_tilt_deg = 30.0f;      ///< the ground is no steeper, seen from the sensor
    float cluster_tolerance_m = 0.7f;  ///< neighbours of a cluster are closer than this
    int min_cluster_points = 10;       ///< smaller clusters, in voxels, are no obstacles
    float zone_m = 20.0f;              ///< returns farther than this are ROU and take no part
};

/// RoI are the returns whose voxel is in a cluster, ROU those of the plane, of clusters too small
/// and farther than `zone_m`; Unclassified out of the sensor's range. An entry a return. RANSAC
/// draws the same samples each time (PCL's fixed seed), so that labels are the same, too.
/// Without a plane, all is clusters.
/// Throws std::invalid_argument where a length or count is not positive, or where the zone holds
/// more voxels than PCL can number.
std::vector<Label> pclEuclideanLabels(const Scan& scan, const SensorModel& sensor,
                                      const PclEuclideanOptions& options = {});

/// To be appended to baselines(): as usual, and as tuned on labelled scans.
std::vector<Baseline> pclBaselines(float zone_m);

}  // namespace hagen::evaluation
