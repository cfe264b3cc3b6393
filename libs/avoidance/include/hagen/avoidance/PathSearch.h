#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <vector>

namespace hagen::avoidance {

struct PathSearchOptions {
    Eigen::AlignedBox3d bounds_m;  ///< the middles of cells lie within
    double cell_m = 0.5;
    double least_clearance_m = 0.65;  ///< of every point of the path
    double wanted_clearance_m = 1.2;  ///< cells with less cost more
    int most_cells = 200000;          ///< to be opened; then the search gives up
    double haste = 1;  ///< 1: the cheapest path; above: up to so many times dearer, found sooner
    Eigen::Vector3d anchor_m{0, 0, 0};  ///< the middle of one of the cells
    double wanted_height_m = 0;
    double height_cost_per_m = 0;  ///< of a metre of way, for each metre off the wanted height
};

/// A* over cubic cells from one place to another, 26 neighbours. A cell is passed at its middle or,
/// where that is too near to an obstacle, at the clearest of four points beside it at the same
/// height; the way from one cell to the next is checked, too, where 5 cm are let pass. Clearances
/// are asked for when a cell is opened, not before. Where the start is too near to an obstacle,
/// ways out with growing clearance are allowed. None where the goal cannot be reached or is out of
/// the bounds. Positions from start to goal, both among them. Ties are broken by the order of
/// cells: the same answers, the same path. Throws std::invalid_argument for bounds or cells that
/// make no grid.
std::optional<std::vector<Eigen::Vector3d>> findPath(
    const std::function<float(const Eigen::Vector3f&)>& clearance_m, const Eigen::Vector3d& start_m,
    const Eigen::Vector3d& goal_m, const PathSearchOptions& options);

}  // namespace hagen::avoidance
