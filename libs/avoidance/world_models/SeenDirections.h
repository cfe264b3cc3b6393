#pragma once
#include <hagen/mrpt/MappedScan.h>
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hagen::avoidance {

/// The nearest and the farthest return from a position in each cell of about 2 degrees. Cells are a
/// grid on the faces of a cube around the position, which needs no arctangents.
class SeenDirections {
 public:
    SeenDirections() : seen_(6 * kCellsAcross * kCellsAcross) {}

    void see(const Eigen::Vector3f& from_origin_m);

    /// Whether a return in this direction was at least as far away.
    bool isSeen(const Eigen::Vector3f& from_origin_m) const;

    enum class Place { Free, NotFree, Unknown };
    /// Free if all returns around this direction were at least half a metre farther. Unknown if
    /// fewer than four of the nine cells around it contain returns.
    Place placeAt(const Eigen::Vector3f& from_origin_m) const;

    std::size_t bytes() const { return seen_.capacity() * sizeof(Returns); }

 private:
    static constexpr int kCellsAcross = 45;
    struct Cell {
        int face, row, column;
        std::size_t index() const {
            return static_cast<std::size_t>((face * kCellsAcross + row) * kCellsAcross + column);
        }
    };
    static Cell cellOf(const Eigen::Vector3f& direction);

    static constexpr std::uint16_t kNone_cm = 65535;
    struct Returns {
        std::uint16_t nearest_cm = kNone_cm, farthest_cm = 0;
    };
    std::vector<Returns> seen_;
};

/// The directions observed by a scan, and its origin.
struct View {
    double time_s;  ///< middle of the revolution, if return ages are known
    Eigen::Vector3f origin_m;
    SeenDirections seen;
};
View viewOf(const observations::MappedScan& scan);

}  // namespace hagen::avoidance
