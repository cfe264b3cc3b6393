#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hagen::avoidance {

/// How far was seen from a place: in each cell of about 2 degrees, the farthest return. The cells
/// are those of a cube's faces around the place, which needs no arctangents.
class SeenDirections {
 public:
    SeenDirections() : seen_cm_(6 * kCellsAcross * kCellsAcross, 0) {}

    void see(const Eigen::Vector3f& from_origin_m);
    bool isSeen(const Eigen::Vector3f& from_origin_m) const;
    std::size_t bytes() const { return seen_cm_.capacity() * sizeof(std::uint16_t); }

 private:
    static constexpr int kCellsAcross = 45;
    static std::size_t cellOf(const Eigen::Vector3f& direction);

    std::vector<std::uint16_t> seen_cm_;  ///< 0: nothing
};

}  // namespace hagen::avoidance
