#include "avoidance/world_models/VoxelTree.h"

#include <cmath>

#include "avoidance/world_models/Nearest.h"

namespace hagen::avoidance {

namespace {

/// Voxels of equal size, given by their centres.
struct Voxels : TreePoints {
    float half_edge_m = 0;
};

/// Squared distance from a point to a cube, for nanoflann. It also applies to the splitting planes,
/// since cubes extend half an edge across them.
struct CubeDistance {
    using ElementType = float;
    using DistanceType = float;

    explicit CubeDistance(const Voxels& voxels) : voxels_(voxels) {}

    float evalMetric(const float* point, std::size_t voxel, std::size_t dimensions) const {
        float sum = 0;
        for (std::size_t axis = 0; axis < dimensions; ++axis) {
            sum += accum_dist(point[axis], voxels_.kdtree_get_pt(voxel, axis), axis);
        }
        return sum;
    }
    float accum_dist(float a, float b, std::size_t) const {
        const float beyond = std::max(0.0f, std::abs(a - b) - voxels_.half_edge_m);
        return beyond * beyond;
    }

 private:
    const Voxels& voxels_;
};

using Index = nanoflann::KDTreeSingleIndexAdaptor<CubeDistance, Voxels, 3>;
constexpr std::size_t kLeafSize = 16;

}  // namespace

struct VoxelTree::Tree {
    Voxels voxels;
    std::unique_ptr<Index> index;
};

VoxelTree::VoxelTree(float edge_m) : tree_(std::make_unique<Tree>()) {
    tree_->voxels.half_edge_m = edge_m / 2;
    rebuild({});
}
VoxelTree::~VoxelTree() = default;

void VoxelTree::rebuild(std::vector<Eigen::Vector3f> centres_m) {
    tree_->voxels.at_m = std::move(centres_m);
    tree_->index = std::make_unique<Index>(3, tree_->voxels, kLeafSize);
}

float VoxelTree::distance_m(const Eigen::Vector3f& point_m, float limit_m) const {
    Nearest nearest(limit_m);
    tree_->index->findNeighbors(nearest, point_m.data(), {});
    return std::sqrt(nearest.worstDist());
}

const std::vector<Eigen::Vector3f>& VoxelTree::centres_m() const { return tree_->voxels.at_m; }

std::size_t VoxelTree::bytes() const {
    return sizeof(Tree) + sizeof(Index) + tree_->index->usedMemory(*tree_->index) +
           tree_->voxels.at_m.capacity() * sizeof(Eigen::Vector3f);
}

}  // namespace hagen::avoidance
