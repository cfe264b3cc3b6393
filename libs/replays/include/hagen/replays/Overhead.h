#pragma once
#include <hagen/trials/LatencyProfile.h>
#include <hagen/trials/RunTable.h>
#include <Eigen/Core>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace hagen::replays {

/// A run seen from above.
struct OverheadView {
    static constexpr double kCell_m = 0.2;

    trials::Run run;
    bool is_same;  ///< flown again, the result is that of the table
    Eigen::Vector2d start_m, goal_m;
    std::vector<Eigen::Vector2d> track_m;             ///< true
    std::vector<Eigen::Vector2d> stops_m;             ///< positions of emergency stops
    std::vector<std::pair<int, int>> obstacle_cells;  ///< x, y; by y, then by x
};

/// Flies the run again. Obstacles are cells with returns between 0.5 and 4.5 m above the ground.
/// Throws like flyAgain(), and whatever `continuing` throws: it is called at each planning step.
OverheadView viewFromAbove(
    const trials::Run& run, const trials::LatencyProfile& profile,
    const std::function<void()>& continuing = [] {});

/// The worst runs: collisions first, then timeouts, by clearance; one per scenario and contender.
/// Runs of the oracle are left out.
std::vector<trials::Run> worstRuns(const std::vector<trials::Run>& runs, std::size_t count);

/// The whole flight from above with a margin, as SVG in metres.
std::string svgOf(const OverheadView& view);

/// The legend of its marks, as an HTML list.
std::string overheadLegend();

}  // namespace hagen::replays
