#pragma once
#include <hagen/mrpt/MapFile.h>
#include <hagen/mrpt/MappedScan.h>
#include <octomap/OcTree.h>
#include <memory>
#include <stdexcept>

namespace hagen::observations {

/// The returns that are inserted into an OctoMap.
enum class MapContent {
    Full,       ///< all returns are hits, and all rays clear (O-Full)
    Roi,        ///< only RoI returns are hits, and only their rays clear (O-RoI)
    RoiAndRays  ///< RoI returns are hits, and all rays clear (O-RoI+rays)
};

/// How rays are inserted. All methods update a voxel once per scan and never clear a voxel with a
/// hit.
enum class RayInsertion {
    OneRayPerVoxel,   ///< our traversal with bit sets; one ray per end voxel
    OctoMap,          ///< OctoMap's insertPointCloud()
    OctoMapDiscrete,  ///< insertPointCloud() with discretization: one ray per end voxel
};

struct ScanMapOptions {
    MapContent content = MapContent::RoiAndRays;
    double resolution_m = 0.2;  ///< edge length of a voxel; > 0
    double max_range_m = 20;    ///< farther returns are not hits, but clear up to this range
    // The defaults are OctoMap's.
    double hit_probability = 0.7, miss_probability = 0.4;
    double min_probability = 0.1192, greatest_probability = 0.971;  ///< clamping limits
    RayInsertion insertion = RayInsertion::OneRayPerVoxel;  ///< the others require MapContent::Full
};

/// The map has reached its maximum size, 50 million nodes (about 3 GiB).
struct MapFull : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// An OctoMap built from segmented scans.
class ScanMap {
 public:
    /// Throws std::invalid_argument unless resolution and range are positive and the probabilities
    /// satisfy 0 < min < miss < 0.5 < hit < greatest < 1, or if more than 2^32 voxels are within
    /// the range.
    explicit ScanMap(const ScanMapOptions& options);

    ~ScanMap();
    ScanMap(ScanMap&&) noexcept;
    ScanMap& operator=(ScanMap&&) noexcept;

    /// Inserts a scan. Each voxel is updated once per scan: occupied if it contains a hit,
    /// otherwise free if a ray passes through; a ray does not clear the voxel in which it ends.
    /// Updates leaves only; inner nodes are updated when the map is saved. Voxels outside the
    /// tree's bounding box (OctoMap's setBBXMin() etc.), if any, are not updated. Throws
    /// std::runtime_error, naming the position, for a scan outside the extent of an OctoMap (32768
    /// voxels from the origin), and MapFull.
    void insert(const MappedScan& scan);

    /// Memory of the tree, computed from the sizes of its parts, and of the buffers.
    std::size_t bytes() const;

    const octomap::OcTree& tree() const { return *tree_; }
    octomap::OcTree& tree() { return *tree_; }
    const ScanMapOptions& options() const { return options_; }

 private:
    ScanMapOptions options_;
    std::size_t max_nodes_ = 0;
    class RayTraversal;
    std::unique_ptr<octomap::OcTree> tree_;
    std::unique_ptr<RayTraversal> walk_;  ///< buffers, reused across scans
};

}  // namespace hagen::observations
