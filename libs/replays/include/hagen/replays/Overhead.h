#pragma once
#include <hagen/trials/LatencyProfile.h>
#include <hagen/trials/RunTable.h>
#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

namespace hagen::replays {

/// A run seen from above.
struct OverheadView {
    static constexpr double kCell_m = 0.2;

    trials::Run run;
    bool is_same;  ///< flown again, it came out as in the table
    Eigen::Vector2d start_m, goal_m;
    std::vector<Eigen::Vector2d> track_m;             ///< true
    std::vector<Eigen::Vector2d> stops_m;             ///< where it braked in an emergency
    std::vector<std::pair<int, int>> obstacle_cells;  ///< x, y; ascending; seen in the air
};

/// Flies the run again. Obstacles are where returns came from between 0.5 and 4.5 m above the
/// ground. Throws as flyAgain() does.
OverheadView viewFromAbove(const trials::Run& run, const trials::LatencyProfile& profile);

/// The runs to look at: collisions first, then timeouts, by clearance; of a scenario and a
/// contender one. The oracle's are left out.
std::vector<trials::Run> worstRuns(const std::vector<trials::Run>& runs, std::size_t count);

/// The flight from above, whole and with a margin, as SVG in metres.
std::string svgOf(const OverheadView& view);

/// What its marks mean, as an HTML list.
std::string overheadLegend();

}  // namespace hagen::replays
