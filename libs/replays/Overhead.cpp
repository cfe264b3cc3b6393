#include <hagen/replays/Overhead.h>

#include <hagen/trials/TrialScore.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include <hagen/pages/Table.h>
#include <hagen/replays/Refly.h>
#include <hagen/trials/Condition.h>

namespace hagen::replays {
namespace {

constexpr double kLowest_m = 0.5, kHighest_m = 4.5;

int cellOf(double at_m) { return static_cast<int>(std::floor(at_m / OverheadView::kCell_m)); }

void addObstacles(const mapping::MappedScan& scan, const simulation::Terrain& ground,
                  std::set<std::pair<int, int>>& cells) {
    for (const Eigen::Vector3f& p : scan.points_m) {
        const double x = static_cast<double>(p.x()), y = static_cast<double>(p.y());
        const double above_m = static_cast<double>(p.z()) - ground.height_m(x, y);
        if (above_m > kLowest_m && above_m < kHighest_m) cells.insert({cellOf(y), cellOf(x)});
    }
}

struct Box {
    double x0, x1, y0, y1;
};

/// The whole flight with a margin, and wide enough to show what it flew around. Marks have a radius
/// of up to 1.5 m.
Box boxOf(const OverheadView& view) {
    constexpr double kRoom_m = 5, kLeastWidthToHeight = 1.5;
    Box box{view.start_m.x(), view.start_m.x(), view.start_m.y(), view.start_m.y()};
    const auto include = [&](const Eigen::Vector2d& at) {
        box = {std::min(box.x0, at.x()), std::max(box.x1, at.x()), std::min(box.y0, at.y()),
               std::max(box.y1, at.y())};
    };
    include(view.goal_m);
    for (const Eigen::Vector2d& at : view.track_m) include(at);
    box = {box.x0 - kRoom_m, box.x1 + kRoom_m, box.y0 - kRoom_m, box.y1 + kRoom_m};
    const double width = box.x1 - box.x0, height = box.y1 - box.y0;
    const double more_y = std::max(0.0, width / kLeastWidthToHeight - height) / 2;
    const double more_x = std::max(0.0, height * kLeastWidthToHeight - width) / 2;
    return {box.x0 - more_x, box.x1 + more_x, box.y0 - more_y, box.y1 + more_y};
}

/// Adjacent cells are one rectangle. The y axis of SVG points down.
std::string cellsPath(const OverheadView& view, const Box& box) {
    constexpr double cell_m = OverheadView::kCell_m;
    std::string path;
    const auto& cells = view.obstacle_cells;
    for (std::size_t i = 0; i < cells.size();) {
        std::size_t end = i + 1;
        while (end < cells.size() && cells[end].second == cells[i].second &&
               cells[end].first == cells[end - 1].first + 1) {
            ++end;
        }
        const double x = cell_m * cells[i].first, y = cell_m * cells[i].second;
        const double length = cell_m * static_cast<double>(end - i);
        if (y > box.y0 && y < box.y1 && x + length > box.x0 && x < box.x1) {
            path += "M" + pages::figure(x, 1) + " " + pages::figure(-y - cell_m, 1) + "h" +
                    pages::figure(length, 1) + "v" + pages::figure(cell_m, 1) + "h" +
                    pages::figure(-length, 1) + "z";
        }
        i = end;
    }
    return path;
}

std::string point(const Eigen::Vector2d& at) {
    return pages::figure(at.x(), 2) + "," + pages::figure(-at.y(), 2);
}

std::string circle(const Eigen::Vector2d& at, double radius_m, const std::string& style) {
    return "<circle cx=\"" + pages::figure(at.x(), 2) + "\" cy=\"" + pages::figure(-at.y(), 2) +
           "\" r=\"" + pages::figure(radius_m, 2) + "\" " + style + "/>";
}

std::string startMark(const Eigen::Vector2d& at) { return circle(at, 0.6, "class=\"start\""); }

/// A circle of the size that counts as arrived, and a dot.
std::string goalMark(const Eigen::Vector2d& at) {
    return circle(at, trials::TrialJudge::kArrived_m, "class=\"goal\"") +
           circle(at, 0.25, "class=\"goal-dot\"");
}

std::string stopMark(const Eigen::Vector2d& at) { return circle(at, 0.25, "class=\"stop\""); }

std::string endMark(const Eigen::Vector2d& at) {
    return "<rect class=\"end\" x=\"" + pages::figure(at.x() - 0.55, 2) + "\" y=\"" +
           pages::figure(-at.y() - 0.55, 2) + "\" width=\"1.1\" height=\"1.1\"/>";
}

std::string hitMark(const Eigen::Vector2d& at) {
    const std::string x = pages::figure(at.x() - 0.9, 2);
    return "<path class=\"hit\" d=\"M" + x + " " + pages::figure(-at.y() - 0.9, 2) + "l1.8 1.8M" +
           x + " " + pages::figure(-at.y() + 0.9, 2) + "l1.8 -1.8\"/>";
}

std::string legendItem(const std::string& mark, const std::string& words) {
    return "<li><svg class=\"overhead\" viewBox=\"-2 -2 4 4\" aria-hidden=\"true\">" + mark +
           "</svg>" + words + "</li>";
}

}  // namespace

OverheadView viewFromAbove(const trials::Run& run, const trials::LatencyProfile& profile,
                           const std::function<void()>& continuing) {
    OverheadView view{run, false, {}, {}, {}, {}, {}};
    const trials::Course course = trials::makeCourse(run.scenario, run.seed);
    std::set<std::pair<int, int>> cells;  // y, x: sorted by rows
    trials::TrialListener listener;
    listener.step = [&](const trials::TrialStep& step) {
        continuing();
        addObstacles(step.scan, course.scene.terrain(), cells);
        if (step.plan.is_emergency) view.stops_m.push_back(step.true_state.position_m.head<2>());
    };
    listener.moved = [&](double, const avoidance::VehicleState& state) {
        view.track_m.push_back(state.position_m.head<2>());
    };
    view.is_same = flyAgain(run, profile, listener).is_same;
    view.start_m = course.start_m.head<2>();
    view.goal_m = course.goal_m.head<2>();
    for (const auto& [y, x] : cells) view.obstacle_cells.emplace_back(x, y);
    return view;
}

std::vector<trials::Run> worstRuns(const std::vector<trials::Run>& runs, std::size_t count) {
    std::vector<trials::Run> ranked = runs;
    const auto badness = [](const trials::Run& run) {
        const trials::Outcome outcome = run.result.outcome;
        return std::make_tuple(outcome != trials::Outcome::Collision,
                               outcome == trials::Outcome::Success, run.result.min_clearance_m);
    };
    std::stable_sort(ranked.begin(), ranked.end(), [&](const trials::Run& a, const trials::Run& b) {
        return badness(a) < badness(b);
    });
    std::set<std::tuple<std::string, std::string, std::string>> shown;
    std::vector<trials::Run> worst;
    for (const trials::Run& run : ranked) {
        if (worst.size() == count) break;
        if (avoidance::needsTruth(run.setup.model)) continue;
        if (!shown.insert({run.scenario, run.setup.model, run.setup.guidance}).second) continue;
        worst.push_back(run);
    }
    return worst;
}

std::string svgOf(const OverheadView& view) {
    const Box box = boxOf(view);
    const double width = box.x1 - box.x0, height = box.y1 - box.y0;
    std::string svg = "<svg class=\"overhead\" viewBox=\"" + pages::figure(box.x0, 1) + " " +
                      pages::figure(-box.y1, 1) + " " + pages::figure(width, 1) + " " +
                      pages::figure(height, 1) +
                      "\" role=\"img\" aria-label=\"The flight from above\">";
    svg += "<path class=\"obstacles\" d=\"" + cellsPath(view, box) + "\"/>";
    svg += "<polyline class=\"track\" points=\"";
    for (std::size_t i = 0; i < view.track_m.size(); i += 5) svg += point(view.track_m[i]) + " ";
    if (!view.track_m.empty()) svg += point(view.track_m.back());
    svg += "\"/>";
    for (const Eigen::Vector2d& at : view.stops_m) svg += stopMark(at);
    svg += startMark(view.start_m) + goalMark(view.goal_m);
    const bool is_collision = view.run.result.outcome == trials::Outcome::Collision;
    if (!view.track_m.empty()) {
        svg += is_collision ? hitMark(view.track_m.back()) : endMark(view.track_m.back());
    }
    // A scale of 5 m.
    const double x = box.x0 + 1, y = -box.y0 - 1;
    svg += "<path class=\"scale\" d=\"M" + pages::figure(x, 1) + " " + pages::figure(y, 1) +
           "h5\"/><text x=\"" + pages::figure(x, 1) + "\" y=\"" + pages::figure(y - 0.4, 1) +
           "\">5 m</text>";
    return svg + "</svg>\n";
}

std::string overheadLegend() {
    const Eigen::Vector2d middle(0, 0);
    return "<ul class=\"legend\">" + legendItem(startMark(middle), "start") +
           legendItem(goalMark(middle), "goal") +
           legendItem("<path class=\"track\" d=\"M-2 0h4\"/>", "true path") +
           legendItem(endMark(middle), "end, no collision") +
           legendItem(hitMark(middle), "collision") +
           legendItem(stopMark(middle), "emergency stop") +
           legendItem("<path class=\"obstacles\" d=\"M-1 -1h2v2h-2z\"/>",
                      "LiDAR returns 0.5 to 4.5 m above the ground") +
           "</ul>\n";
}

}  // namespace hagen::replays
