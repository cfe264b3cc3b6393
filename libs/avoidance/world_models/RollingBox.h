#pragma once
#include <hagen/avoidance/WindowSize.h>
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hagen::avoidance {

/// Required reach of a robocentric map from the vehicle in x, y, z: horizontally that of a window
/// (the reach of a plan, at least 15 m); vertically the climb of a plan over that distance, plus
/// the reach of a clearance. 15 x 15 x 6 m at 4 m/s.
Eigen::Vector3f rollingReachFor(const FlightPace& pace);

/// Maps the voxels of a box that moves with a vehicle to storage. Its size is constant; an index
/// belongs to a position modulo the size, so that moving copies no data: entering voxels replace
/// leaving voxels.
///
/// Voxels are grouped for bit masks of 64: 4 x 4 x 4 voxels form a block, 4 x 4 x 4 blocks a group.
/// An index is 4096 group + 64 block + voxel; within a block, voxel = 16 z + 4 y + x, and likewise
/// for blocks. The box moves by whole blocks.
class RollingBox {
 public:
    static constexpr int kBlock = 4, kGroup = 16;  ///< edges in voxels

    /// The box extends at least `reach_m` from the vehicle in each direction.
    RollingBox(float edge_m, const Eigen::Vector3f& reach_m);

    /// Moves the box to the vehicle. Returns the blocks whose content leaves it, ascending.
    const std::vector<std::uint32_t>& moveTo(const Eigen::Vector3f& vehicle_m);

    float edge_m() const { return edge_m_; }
    const Eigen::Array3i& size() const { return size_; }  ///< size in voxels
    const Eigen::Array3i& min() const { return min_; }    ///< voxel at the minimum corner
    std::size_t voxels() const { return blocks() * 64; }
    std::size_t blocks() const { return groups() * 64; }
    std::size_t groups() const { return static_cast<std::size_t>(groups_.prod()); }

    /// A point in voxels from the minimum corner. Voxel (0, 0, 0) is [0, 1).
    Eigen::Array3f inVoxels(const Eigen::Vector3f& point_m) const {
        return point_m.array() * per_edge_ - min_.cast<float>();
    }
    bool holds(const Eigen::Array3f& in_voxels) const {
        return (in_voxels >= 0).all() && (in_voxels < size_.cast<float>()).all();
    }
    /// The centre of a voxel, given by its position from the minimum corner.
    Eigen::Vector3f centre_m(const Eigen::Array3i& place) const {
        return ((place + min_).cast<float>() + 0.5f) * edge_m_;
    }

    /// Index of a voxel of the box: the sum over its axes.
    std::uint32_t indexOf(const Eigen::Array3i& place) const {
        return part(0)[place.x()] + part(1)[place.y()] + part(2)[place.z()];
    }
    /// Part of the index for a position along an axis. May be read one position outside the box.
    const std::uint32_t* part(int axis) const {
        return parts_[static_cast<std::size_t>(axis)].data() + 1;
    }
    /// The part of a group's number that one axis contributes. `group` is the group's position in
    /// the map along this axis, in groups.
    std::uint32_t groupPart(int axis, int group) const;
    /// Position of a block's first voxel.
    Eigen::Array3i placeOf(std::uint32_t block) const;

    std::size_t bytes() const;

 private:
    void fillParts();

    float edge_m_, per_edge_;
    Eigen::Array3i groups_, size_, min_{0, 0, 0};
    bool is_placed_ = false;
    std::array<std::vector<std::uint32_t>, 3> parts_;
    std::vector<std::uint32_t> left_;
};

}  // namespace hagen::avoidance
