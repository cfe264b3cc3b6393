#pragma once
#include <hagen/mapping/MapFile.h>
#include <hagen/mapping/MappedScan.h>
#include <octomap/OcTree.h>
#include <memory>

namespace hagen::mapping {

/// What of a segmented scan goes into an OctoMap.
enum class MapContent {
    Full,       ///< every return is a hit, every ray clears (O-Full)
    Roi,        ///< RoI returns alone, hits and rays (O-RoI)
    RoiAndRays  ///< RoI returns are hits, the rays of all returns clear (O-RoI+rays)
};

struct ScanMapOptions {
    MapContent content = MapContent::RoiAndRays;
    double resolution_m = 0.2;  ///< edge of a voxel; more than 0
    double max_range_m = 20;    ///< farther returns clear up to here, and are no hits
};

/// An OctoMap that segmented scans are put into.
class ScanMap {
 public:
    /// Throws std::invalid_argument for a resolution or a range that is not more than 0.
    explicit ScanMap(const ScanMapOptions& options);

    ~ScanMap();
    ScanMap(ScanMap&&) noexcept;
    ScanMap& operator=(ScanMap&&) noexcept;

    /// Each voxel once a scan: hit where a hit lies in it, else free where a ray passes; a ray
    /// that ends in a voxel does not clear it. Leaves only: inner nodes are brought up to date when
    /// the map is saved. Where the tree has a bounding box (octomap's setBBXMin() and so on),
    /// nothing outside it.
    /// Throws std::runtime_error, saying where it lies, for a scan that is farther from the map's
    /// origin than an OctoMap reaches: 32768 voxels.
    void insert(const MappedScan& scan);

    /// Of the tree, by the sizes of its parts, and of the memory that is used again.
    std::size_t bytes() const;

    const octomap::OcTree& tree() const { return *tree_; }
    octomap::OcTree& tree() { return *tree_; }
    const ScanMapOptions& options() const { return options_; }

 private:
    ScanMapOptions options_;
    class RayWalk;
    std::unique_ptr<octomap::OcTree> tree_;
    std::unique_ptr<RayWalk> walk_;  ///< memory that is used again from scan to scan
};

}  // namespace hagen::mapping
