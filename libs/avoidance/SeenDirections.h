#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hagen::avoidance {

/// The farthest return from a position in each cell of about 2 degrees. Cells are a grid on the
/// faces of a cube around the position, which needs no arctangents.
class SeenDirections {
 public:
    SeenDirections() : seen_cm_(6 * kCellsAcross * kCellsAcross, 0) {}

    void see(const Eigen::Vector3f& from_origin_m);
    bool isSeen(const Eigen::Vector3f& from_origin_m) const;
    std::size_t bytes() const { return seen_cm_.capacity() * sizeof(std::uint16_t); }

 private:
    static constexpr int kCellsAcross = 45;
    static std::size_t cellOf(const Eigen::Vector3f& direction);

    std::vector<std::uint16_t> seen_cm_;  ///< 0: no return
};

}  // namespace hagen::avoidance
