#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

namespace hagen::avoidance {

/// Points sorted into the cells of a grid, for thousands of searches for the nearest one. It is
/// built in the time of some hundred searches of k-d trees, and answers several times faster.
class PointGrid {
 public:
    /// Of the points, those count that can be nearest to a point of the box (not empty) within the
    /// limit.
    PointGrid(const std::vector<Eigen::Vector3f>& points_m, const Eigen::AlignedBox3f& box_m,
              float limit_m);

    /// The squared distance to the nearest point, or the squared limit if none is nearer: exactly
    /// the bits that `Nearest` gives after a search of nanoflann. Nothing for a point outside the
    /// box; nor if another distance differs by less than the rounding errors with which nanoflann
    /// chooses where not to look, so that its answer may be either.
    std::optional<float> minDistance_m2(const Eigen::Vector3f& point_m) const;

 private:
    /// A row of cells along x, relative to the one of a query.
    struct Row {
        int y, z;
        float min_m2;  ///< squared distance from any point in the query's row, rather too short
    };
    void sortPoints(const std::vector<Eigen::Vector3f>& points_m);
    void listRows();
    /// From a coordinate to a cell along an axis, rather too short.
    float distanceToCell_m(float at_m, int cell, int axis) const;

    Eigen::AlignedBox3f box_m_;
    float limit_m_, edge_m_ = 0.3f;
    Eigen::Vector3f corner_m_{0, 0, 0};
    Eigen::Vector3i size_{0, 0, 0};
    std::vector<float> at_m_[3];  ///< the points' coordinates, by cell, along x first
    std::vector<std::uint32_t>
        begin_;              ///< of a cell's points; one more than cells. Empty: no point
    int most_ = 0;           ///< rows on each side that are within the limit
    std::vector<Row> rows_;  ///< these, nearest first
};

}  // namespace hagen::avoidance
