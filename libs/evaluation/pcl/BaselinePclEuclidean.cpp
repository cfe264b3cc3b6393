#include <hagen/pcl_baseline/BaselinePclEuclidean.h>
#include <hagen/scan/Angle.h>
#include <pcl/console/print.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>
#include <pcl/segmentation/sac_segmentation.h>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

namespace hagen::evaluation {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

void requireSensible(const PclEuclideanOptions& options) {
    const bool is_sensible = options.leaf_m > 0.0f && options.plane_distance_m > 0.0f &&
                             options.plane_iterations > 0 && options.plane_tilt_deg > 0.0f &&
                             options.cluster_tolerance_m > 0.0f && options.min_cluster_points > 0;
    if (!is_sensible) {
        throw std::invalid_argument("pcl baseline: every length, angle and count must be positive");
    }
    // PCL numbers voxels with 32 bits and reports overflows only on the terminal.
    const double edge = std::ceil(2.0 * static_cast<double>(options.zone_m / options.leaf_m)) + 1.0;
    if (edge * edge * edge > static_cast<double>(std::numeric_limits<std::int32_t>::max())) {
        throw std::invalid_argument("pcl baseline: voxels of " + std::to_string(options.leaf_m) +
                                    " m are too small for a zone of " +
                                    std::to_string(options.zone_m) + " m; use a larger leaf_m");
    }
}

/// Suppresses PCL's terminal message for "no plane found", which is a valid result here.
class SilentPcl {
 public:
    SilentPcl() { pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS); }
    ~SilentPcl() { pcl::console::setVerbosityLevel(before_); }
    SilentPcl(const SilentPcl&) = delete;
    SilentPcl& operator=(const SilentPcl&) = delete;

 private:
    pcl::console::VERBOSITY_LEVEL before_ = pcl::console::getVerbosityLevel();
};

/// Returns the largest plane within the tilt limit for ground; empty if not found.
pcl::PointIndices findGround(const Cloud::ConstPtr& cloud, const PclEuclideanOptions& options) {
    pcl::PointIndices ground;
    if (cloud->size() < 3) return ground;
    pcl::SACSegmentation<pcl::PointXYZ> plane_search(false);  // false: same samples every time
    plane_search.setModelType(pcl::SACMODEL_PERPENDICULAR_PLANE);
    plane_search.setAxis(Eigen::Vector3f::UnitZ());
    plane_search.setEpsAngle(radians(static_cast<double>(options.plane_tilt_deg)));
    plane_search.setMethodType(pcl::SAC_RANSAC);
    plane_search.setOptimizeCoefficients(true);
    plane_search.setMaxIterations(options.plane_iterations);
    plane_search.setDistanceThreshold(static_cast<double>(options.plane_distance_m));
    plane_search.setInputCloud(cloud);
    pcl::ModelCoefficients plane;
    const SilentPcl silence;
    plane_search.segment(ground, plane);
    return ground;
}

/// Marks the points in clusters of non-ground points.
std::vector<bool> findObstacles(const Cloud::ConstPtr& cloud, const PclEuclideanOptions& options) {
    std::vector<bool> is_rest(cloud->size(), true);
    for (const auto i : findGround(cloud, options).indices) is_rest[i] = false;
    const pcl::IndicesPtr rest(new pcl::Indices);
    for (std::size_t i = 0; i < cloud->size(); ++i) {
        if (is_rest[i]) rest->push_back(static_cast<pcl::index_t>(i));
    }
    std::vector<bool> is_obstacle(cloud->size(), false);
    if (rest->empty()) return is_obstacle;

    const pcl::search::KdTree<pcl::PointXYZ>::Ptr tree(new pcl::search::KdTree<pcl::PointXYZ>);
    tree->setInputCloud(cloud, rest);
    pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
    extraction.setClusterTolerance(static_cast<double>(options.cluster_tolerance_m));
    extraction.setMinClusterSize(options.min_cluster_points);
    extraction.setSearchMethod(tree);
    extraction.setInputCloud(cloud);
    extraction.setIndices(rest);
    std::vector<pcl::PointIndices> clusters;
    extraction.extract(clusters);
    for (const pcl::PointIndices& cluster : clusters) {
        for (const auto i : cluster.indices) is_obstacle[i] = true;
    }
    return is_obstacle;
}

Baseline baseline(const std::string& name, const PclEuclideanOptions& options) {
    std::ostringstream parameters;
    parameters << "leaf " << options.leaf_m << " m, plane " << options.plane_distance_m << " m in "
               << options.plane_iterations << " iterations and " << options.plane_tilt_deg
               << " deg of level, tolerance " << options.cluster_tolerance_m << " m, clusters from "
               << options.min_cluster_points;
    return {name,
            "Point Cloud Library, voxel grid, RANSAC plane, Euclidean clusters",
            parameters.str(),
            [options](const Scan& scan, const SensorModel& sensor) {
                return pclEuclideanLabels(scan, sensor, options);
            },
            "plane_m",
            [name, options](float limit) {
                PclEuclideanOptions changed = options;
                changed.plane_distance_m = limit;
                return baseline(name, changed);
            }};
}

}  // namespace

std::vector<Label> pclEuclideanLabels(const Scan& scan, const SensorModel& sensor,
                                      const PclEuclideanOptions& options) {
    requireSensible(options);
    std::vector<Label> labels(scan.size(), Label::Unclassified);
    const Cloud::Ptr near(new Cloud);
    std::vector<std::size_t> returns;  // indices in the scan, in the order of the cloud
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (!sensor.sees(scan.range_m[i])) continue;
        labels[i] = Label::Rou;
        if (scan.range_m[i] > options.zone_m) continue;
        near->emplace_back(scan.x_m[i], scan.y_m[i], scan.z_m[i]);
        returns.push_back(i);
    }
    if (near->empty()) return labels;

    pcl::VoxelGrid<pcl::PointXYZ> grid;
    grid.setInputCloud(near);
    grid.setLeafSize(options.leaf_m, options.leaf_m, options.leaf_m);
    grid.setSaveLeafLayout(true);
    const Cloud::Ptr centroids(new Cloud);
    grid.filter(*centroids);
    const std::vector<bool> is_obstacle = findObstacles(centroids, options);
    for (std::size_t k = 0; k < returns.size(); ++k) {
        if (is_obstacle[grid.getCentroidIndex((*near)[k])]) labels[returns[k]] = Label::Roi;
    }
    return labels;
}

std::vector<Baseline> pclBaselines(float zone_m) {
    PclEuclideanOptions usual;
    usual.zone_m = zone_m;
    PclEuclideanOptions tuned = usual;
    tuned.plane_distance_m = 0.25f;
    tuned.min_cluster_points = 1;
    return {baseline("pcl-euclidean", usual), baseline("pcl-euclidean tuned", tuned)};
}

}  // namespace hagen::evaluation
