#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <vector>

namespace hagen::avoidance {

/// Maps extend this far beyond the bounds of the flight, because obstacles there restrict flight
/// along the edge.
constexpr float kMapMargin_m = 3.0f;

/// The exact distance to the nearest occupied voxel of a map. It is measured to the voxel's faces,
/// because the obstacle may be at the near side. Rebuilding the tree for each scan is much faster
/// than updating a distance transform of the whole map.
class VoxelTree {
 public:
    explicit VoxelTree(float edge_m);
    ~VoxelTree();

    void rebuild(std::vector<Eigen::Vector3f> centres_m);

    /// 0 inside a voxel; `limit_m` if none is closer.
    float distance_m(const Eigen::Vector3f& point_m, float limit_m) const;
    const std::vector<Eigen::Vector3f>& centres_m() const;
    std::size_t bytes() const;

 private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

}  // namespace hagen::avoidance
