#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <vector>

namespace hagen {

struct PathSearchOptions {
    Eigen::AlignedBox3d bounds_m;  ///< cells lie within
    double cell_m = 0.5;
    double least_clearance_m = 0.65;  ///< of every cell of the path
    double wanted_clearance_m = 1.2;  ///< cells with less cost more
    int most_cells = 200000;          ///< to be opened; then the search gives up
};

/// A* over cubic cells from one place to another, 26 neighbours, through cells whose clearance
/// suffices; asked once a cell. Where the start is too near to an obstacle, cells on the way out
/// are allowed. None where the goal cannot be reached. Positions from start to goal.
std::optional<std::vector<Eigen::Vector3d>> findPath(
    const std::function<float(const Eigen::Vector3f&)>& clearance_m, const Eigen::Vector3d& start_m,
    const Eigen::Vector3d& goal_m, const PathSearchOptions& options);

}  // namespace hagen
