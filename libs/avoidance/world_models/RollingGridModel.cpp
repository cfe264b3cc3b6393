#include <algorithm>
#include <cmath>
#include <limits>

#include "avoidance/world_models/Maps.h"
#include "avoidance/world_models/RollingBox.h"
#include "avoidance/world_models/VoxelSet.h"

namespace hagen::avoidance {
namespace {

// Log odds in units of 1/24, so that they fit into a byte. As in OctoMap: +0.85 (probability 0.7)
// for a hit, -0.41 (0.4) for a miss, limits -2 (0.12) and 3.5 (0.97). Occupied: 0 or more.
constexpr int kHit = 20, kMiss = 10, kMin = -48, kMax = 84;
constexpr std::int8_t kUnknown = std::numeric_limits<std::int8_t>::min();

// Marks of voxels. They are bytes, which a ray sets without reading: with bits, each step would
// wait for the previous one.
constexpr std::int8_t kNotSeen = 0, kPassed = 1, kIsHit = 2;

/// An occupancy grid in a box that moves with the vehicle, so that memory is constant, as in
/// ROG-Map (Ren et al. 2023, arXiv 2302.14819): circular indexing, log odds by ray traversal.
///
/// A voxel is updated once per scan: occupied if it contains a return, otherwise free if a ray
/// passes through. Rays that end in the same voxel are merged into one ray to its centre. Returns
/// beyond the range of a window (15 m at 4 m/s) only clear voxels, up to that range or the border
/// of the box. Instead of ROG-Map's inflated copy for one vehicle radius, VoxelSet computes exact
/// distances from a bit per occupied voxel.
class RollingGridModel : public WorldModel {
 public:
    RollingGridModel(float edge_m, const FlightPace& pace)
        : max_range_m_(windowSizeFor(pace).radius_m),
          box_(edge_m, rollingReachFor(pace)),
          log_odds_(box_.voxels(), kUnknown),
          occupied_(box_),
          marks_(box_.voxels(), kNotSeen),
          is_marked_(box_.blocks(), 0) {}

    void update(const observations::MappedScan& scan) override {
        for (const std::uint32_t block : box_.moveTo(scan.origin_m)) {
            std::fill_n(log_odds_.begin() + std::ptrdiff_t{64} * block, 64, kUnknown);
            occupied_.setBlock(block, 0);
        }
        markEnds(scan);
        const Eigen::Array3f origin = box_.inVoxels(scan.origin_m);
        for (const Eigen::Array3i& end : ends_) trace(origin, end);
        for (const std::uint32_t index : hits_) marks_[index] = kIsHit;  // overrides passing rays
        apply();
    }
    float clearanceWithin_m(const Eigen::Vector3f& point_m, float limit_m) const override {
        return occupied_.distance_m(box_, point_m, std::min(limit_m, kReach_m));
    }
    bool isKnown(const Eigen::Vector3f& point_m) const override {
        const Eigen::Array3f at = box_.inVoxels(point_m);
        return box_.holds(at) && log_odds_[box_.indexOf(at.cast<int>())] != kUnknown;
    }
    std::size_t bytes() const override {
        return sizeof(*this) + box_.bytes() + log_odds_.capacity() + occupied_.bytes() +
               marks_.capacity() + is_marked_.capacity() +
               hits_.capacity() * sizeof(std::uint32_t) + ends_.capacity() * sizeof(Eigen::Array3i);
    }
    Obstacles obstacles() const override { return {occupied_.centres_m(box_), box_.edge_m()}; }

 private:
    /// Marks hits and determines the ends of rays, each voxel once.
    void markEnds(const observations::MappedScan& scan) {
        ends_.clear();
        hits_.clear();
        const Eigen::Array3f origin = box_.inVoxels(scan.origin_m);
        const Eigen::Array3f size = box_.size().cast<float>();
        const float range = max_range_m_ / box_.edge_m();
        const auto markEnd = [&](const Eigen::Vector3f& point_m, bool is_return) {
            const Eigen::Array3f at = box_.inVoxels(point_m);
            const Eigen::Array3f ray = at - origin;
            const float beyond = ray.matrix().norm() / range;
            const bool is_inside = beyond <= 1 && box_.holds(at), is_hit = is_inside && is_return;
            Eigen::Array3i end;
            if (is_inside) {
                end = at.cast<int>();
            } else {
                const Eigen::Array3f wall = (ray > 0).select(size - origin, -origin);
                const float to_wall = (ray == 0).select(1, wall / ray).minCoeff();
                const float share = std::min(to_wall, 1 / beyond);
                end = (origin + share * ray).cast<int>().max(0).min(box_.size() - 1);
            }
            const std::uint32_t index = box_.indexOf(end);
            // A shortened ray passes through its last voxel.
            const std::int8_t mark = is_hit ? kIsHit : kPassed;
            if (marks_[index] >= mark) return;
            marks_[index] = mark;
            is_marked_[index / 64] = 1;
            ends_.push_back(end);
            if (is_hit) hits_.push_back(index);
        };
        for (const Eigen::Vector3f& point_m : scan.points_m) markEnd(point_m, true);
        for (const Eigen::Vector3f& to_m : scan.passed_to_m) markEnd(to_m, false);
    }
    /// Marks the voxels from the origin to the end (exclusive) as passed (Amanatides & Woo 1987).
    /// The ray's length is scaled to the integer 2^32, so that rounding errors do not add up.
    void trace(const Eigen::Array3f& origin, const Eigen::Array3i& end) {
        constexpr double kLength = 4294967296.0, kNever = 1e15;
        const Eigen::Array3i start = origin.cast<int>();
        std::int64_t next[3], per_voxel[3];
        std::ptrdiff_t step[3];
        const std::uint32_t* part[3];
        int steps = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double ray = end[axis] + 0.5 - static_cast<double>(origin[axis]);
            const double length = std::min(kNever, kLength / std::max(std::abs(ray), 1e-9));
            const double to_wall = ray > 0 ? start[axis] + 1 - static_cast<double>(origin[axis])
                                           : static_cast<double>(origin[axis]) - start[axis];
            next[axis] = static_cast<std::int64_t>(to_wall * length);
            per_voxel[axis] = static_cast<std::int64_t>(length);
            step[axis] = ray > 0 ? 1 : -1;
            part[axis] = box_.part(axis) + start[axis];
            steps += std::abs(end[axis] - start[axis]);
        }
        const std::uint32_t *x = part[0], *y = part[1], *z = part[2];
        std::int8_t *marks = marks_.data(), *is_marked = is_marked_.data();
        std::int64_t next_x = next[0], next_y = next[1], next_z = next[2];
        for (; steps > 0; --steps) {
            const std::uint32_t index = *x + *y + *z;
            marks[index] = kPassed;
            is_marked[index / 64] = 1;
            // Uses masks instead of unpredictable branches.
            const std::int64_t is_x = -std::int64_t{(next_x <= next_y) & (next_x <= next_z)};
            const std::int64_t is_y = ~is_x & -std::int64_t{next_y <= next_z};
            const std::int64_t is_z = ~(is_x | is_y);
            x += is_x & step[0];
            y += is_y & step[1];
            z += is_z & step[2];
            next_x += is_x & per_voxel[0];
            next_y += is_y & per_voxel[1];
            next_z += is_z & per_voxel[2];
        }
    }
    /// Updates the log odds and the occupied voxels, and clears the marks.
    void apply() {
        for (std::size_t block = 0; block < is_marked_.size(); ++block) {
            if (is_marked_[block] == 0) continue;
            is_marked_[block] = 0;
            std::uint64_t occupied = 0;
            for (unsigned bit = 0; bit < 64; ++bit) {
                std::int8_t& at = log_odds_[64 * block + bit];
                const std::int8_t mark = marks_[64 * block + bit];
                if (mark != kNotSeen) {
                    const int was = at == kUnknown ? 0 : at;
                    at = static_cast<std::int8_t>(
                        std::clamp(was + (mark == kIsHit ? kHit : -kMiss), kMin, kMax));
                }
                occupied |= std::uint64_t{at >= 0} << bit;
            }
            std::fill_n(&marks_[64 * block], 64, kNotSeen);
            if (occupied != occupied_.block(block)) occupied_.setBlock(block, occupied);
        }
    }

    float max_range_m_;
    RollingBox box_;
    std::vector<std::int8_t> log_odds_;  ///< per voxel, see RollingGridModel.cpp
    VoxelSet occupied_;
    std::vector<std::int8_t> marks_, is_marked_;  ///< of the scan, per voxel and block
    std::vector<std::uint32_t> hits_;             ///< voxels of the scan's returns
    std::vector<Eigen::Array3i> ends_;            ///< ends of the scan's rays, in voxels of the box
};

}  // namespace

std::unique_ptr<WorldModel> makeRollingGridModel(float edge_m, const FlightPace& pace) {
    return std::make_unique<RollingGridModel>(edge_m, pace);
}

}  // namespace hagen::avoidance
