#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "avoidance/world_models/RollingBox.h"

namespace hagen::avoidance {

/// Calls `visit` with the number of each set bit.
template <class Visit>
void forEachBit(std::uint64_t bits, const Visit& visit) {
    for (; bits != 0; bits &= bits - 1) visit(static_cast<unsigned>(__builtin_ctzll(bits)));
}

/// A set of voxels of a RollingBox: a bit per voxel and per non-empty block, so that empty space is
/// skipped 4096 voxels at a time. It is updated block by block, and computes the exact distance to
/// its nearest voxel without a distance field.
class VoxelSet {
 public:
    explicit VoxelSet(const RollingBox& box) : voxels_(box.blocks(), 0), blocks_(box.groups(), 0) {}

    std::uint64_t block(std::size_t block) const { return voxels_[block]; }
    /// Non-empty blocks of a group.
    std::uint64_t group(std::size_t group) const { return blocks_[group]; }
    std::size_t groups() const { return blocks_.size(); }

    void setBlock(std::size_t block, std::uint64_t voxels) {
        voxels_[block] = voxels;
        const std::uint64_t bit = std::uint64_t{1} << (block % 64);
        std::uint64_t& group = blocks_[block / 64];
        group = voxels != 0 ? group | bit : group & ~bit;
    }
    bool has(std::uint32_t index) const { return (voxels_[index / 64] >> (index % 64)) & 1; }

    /// The distance to the nearest voxel's faces; 0 inside a voxel, `limit_m` if none is closer.
    float distance_m(const RollingBox& box, const Eigen::Vector3f& point_m, float limit_m) const;

    /// The centres of all voxels, in index order.
    std::vector<Eigen::Vector3f> centres_m(const RollingBox& box) const;

    std::size_t bytes() const {
        return (voxels_.capacity() + blocks_.capacity()) * sizeof(std::uint64_t);
    }

 private:
    std::vector<std::uint64_t> voxels_, blocks_;
};

}  // namespace hagen::avoidance
