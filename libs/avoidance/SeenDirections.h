#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hagen {

/// How far was seen from a place: in each 2 degree cell of the sphere, the farthest return.
class SeenDirections {
 public:
    SeenDirections() : seen_cm_(kColumns * kRows, 0) {}

    void see(const Eigen::Vector3f& from_origin_m);
    bool isSeen(const Eigen::Vector3f& from_origin_m) const;
    std::size_t bytes() const { return seen_cm_.capacity() * sizeof(std::uint16_t); }

 private:
    static constexpr int kColumns = 180, kRows = 91;
    static std::size_t cellOf(const Eigen::Vector3f& direction);

    std::vector<std::uint16_t> seen_cm_;  ///< 0: nothing
};

}  // namespace hagen
