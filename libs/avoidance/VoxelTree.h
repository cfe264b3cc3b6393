#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <vector>

namespace hagen::avoidance {

/// How far beyond the bounds of a flight maps look for obstacles: what stands there is in the way
/// of one that goes along the edge.
constexpr float kMapMargin_m = 3.0f;

/// The distance to the nearest of many cubes, the occupied voxels of a map: an occupied voxel
/// claims that something is in it, which may be at the side that faces the one who asks. Exact,
/// and made anew for each scan in a fraction of what a distance transform of the whole map takes
/// to follow the changes.
class VoxelTree {
 public:
    explicit VoxelTree(float edge_m);
    ~VoxelTree();

    void rebuild(std::vector<Eigen::Vector3f> middles_m);

    /// 0 within a cube; `most_m` where none is nearer.
    float distance_m(const Eigen::Vector3f& point_m, float most_m) const;
    const std::vector<Eigen::Vector3f>& middles_m() const;
    std::size_t bytes() const;

 private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

}  // namespace hagen::avoidance
