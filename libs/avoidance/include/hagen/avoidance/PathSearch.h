#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <vector>

namespace hagen::avoidance {

struct PathSearchOptions {
    Eigen::AlignedBox3d bounds_m;  ///< contains the centres of all cells
    double cell_m = 0.5;
    double min_clearance_m = 0.65;    ///< required at every point of the path
    double wanted_clearance_m = 1.2;  ///< cells with less clearance cost more
    int max_cells = 200000;           ///< limit of expanded cells before giving up
    double heuristic_weight =
        1;  ///< 1: the cheapest path; w > 1: at most w times its cost, found sooner (weighted A*)
    Eigen::Vector3d anchor_m{0, 0, 0};  ///< the centre of one of the cells
    double wanted_height_m = 0;
    double height_cost_per_m = 0;  ///< extra cost per metre of path and metre off the target height
};

/// A* over cubic cells with 26 neighbours (weighted, Pohl 1970). A cell is passed at its centre or,
/// if that is too close to an obstacle, at the clearest of four points beside it at the same
/// height. The edge to the next cell is checked, too, with a tolerance of 5 cm. Clearances are
/// queried when a cell is expanded. If the start is too close to an obstacle, paths with growing
/// clearance are allowed.
///
/// Returns positions from start to goal, both included, or nothing if the goal is out of bounds or
/// cannot be reached. Ties are broken by the order of cells, so equal clearances lead to equal
/// paths. Throws std::invalid_argument if bounds and cell size do not define a grid.
std::optional<std::vector<Eigen::Vector3d>> findPath(
    const std::function<float(const Eigen::Vector3f&)>& clearance_m, const Eigen::Vector3d& start_m,
    const Eigen::Vector3d& goal_m, const PathSearchOptions& options);

}  // namespace hagen::avoidance
