#include <hagen/avoidance/PathSearch.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <queue>
#include <stdexcept>

namespace hagen::avoidance {
namespace {

using Clearance = std::function<float(const Eigen::Vector3f&)>;

/// Costs are integers of 0.1 mm, so that sums are exact and ties are the same on every machine.
using Cost = std::int64_t;
constexpr double kCostPerMetre = 10000;
constexpr double kProximityCost = 2;  ///< extra cost per metre at the minimum clearance
constexpr double kCheckStep_m = 0.1;
constexpr double kGrazing_m = 0.05;  ///< tolerance of edges between cells
constexpr std::int64_t kMostCellsOfGrid = 30'000'000;

/// State of a cell. Valid only if it has the number of the current search.
struct Cell {
    std::uint32_t search = 0;
    int parent;
    Cost cost;
    float clearance_m;
    Cost extra_permille;  ///< extra cost per metre
    std::int8_t place;    ///< passing point; -1: not known yet, -2: none
    bool is_closed;
};

struct Entry {
    Cost estimate, cost;
    int cell, parent;
    bool is_exact;  ///< false: clearance not queried yet, may cost more

    /// Among equal estimates, the one with more path done goes first, then exact ones.
    bool operator<(const Entry& other) const {
        if (estimate != other.estimate) return estimate > other.estimate;
        if (cost != other.cost) return cost < other.cost;
        if (is_exact != other.is_exact) return other.is_exact;
        if (cell != other.cell) return cell > other.cell;
        return parent > other.parent;
    }
};

double extraCost(double clearance_m, double height_m, const PathSearchOptions& options) {
    const double range_m = options.wanted_clearance_m - options.min_clearance_m;
    const double short_m = options.wanted_clearance_m - clearance_m;
    const double share = range_m > 0 ? std::clamp(short_m / range_m, 0.0, 1.0) : 0.0;
    return kProximityCost * share +
           options.height_cost_per_m * std::abs(height_m - options.wanted_height_m);
}

class Search {
 public:
    Search(const Clearance& clearance_m, const Eigen::Vector3d& start_m,
           const Eigen::Vector3d& goal_m, const PathSearchOptions& options);
    std::optional<std::vector<Eigen::Vector3d>> run();

 private:
    Cell& cell(int index);
    Eigen::Vector3i placeOf(int index) const;
    int indexOf(const Eigen::Vector3i& place) const {
        return (place.z() * size_.y() + place.y()) * size_.x() + place.x();
    }
    Eigen::Vector3d pointOf(int index, int place) const;
    void look(int index);
    bool mayPass(int from, int to);
    Cost costOfStep(int from, int to) const;
    Cost leastCostToGoal(const Eigen::Vector3i& place) const;
    void push(int from, int to, const Eigen::Vector3i& place, Cost length);
    void open(int index);
    std::vector<Eigen::Vector3d> pathTo(int index) const;

    const Clearance& clearance_m_;
    const Eigen::Vector3d start_m_, goal_m_;
    const PathSearchOptions& options_;
    Eigen::Vector3i least_, size_;  ///< of the grid, in cells from the anchor
    int start_ = 0, goal_ = 0;
    std::uint32_t number_ = 0;
    Cost heuristic_permille_;
    std::vector<Cell>& cells_;
    std::vector<Entry> entries_;  ///< a heap
    std::array<Cost, 4> lengths_{};
};

/// Reused by later searches, because clearing it would cost more than most searches.
struct Memory {
    std::vector<Cell> cells;
    std::uint32_t search = 0;
};
Memory& memory() {
    thread_local Memory memory;
    return memory;
}

Search::Search(const Clearance& clearance_m, const Eigen::Vector3d& start_m,
               const Eigen::Vector3d& goal_m, const PathSearchOptions& options)
    : clearance_m_(clearance_m),
      start_m_(start_m),
      goal_m_(goal_m),
      options_(options),
      heuristic_permille_(std::llround(1000 * std::max(1.0, options.heuristic_weight))),
      cells_(memory().cells) {
    if (!(options.cell_m > 0) || options.bounds_m.isEmpty()) {
        throw std::invalid_argument("path search: cells need a size, and bounds to lie in");
    }
    const auto nearest = [&](const Eigen::Vector3d& at_m) -> Eigen::Vector3d {
        return ((at_m - options.anchor_m) / options.cell_m).array().round();
    };
    const Eigen::Vector3d low =
        ((options.bounds_m.min() - options.anchor_m) / options.cell_m).array() - 1e-9;
    const Eigen::Vector3d high =
        ((options.bounds_m.max() - options.anchor_m) / options.cell_m).array() + 1e-9;
    // The start cell always belongs to the grid, because the vehicle is there.
    const Eigen::Vector3d first = low.array().ceil().min(nearest(start_m).array());
    const Eigen::Vector3d last = high.array().floor().max(nearest(start_m).array());
    const Eigen::Vector3d count = (last - first).array() + 1;
    if (!((count.array() >= 1).all() && count.prod() <= double(kMostCellsOfGrid))) {
        throw std::invalid_argument("path search: the bounds hold no cells, or too many");
    }
    least_ = first.cast<int>();
    size_ = count.cast<int>();
    start_ = indexOf(nearest(start_m).cast<int>() - least_);
    const Eigen::Vector3d goal = nearest(goal_m);
    const bool has_goal = (goal.array() >= first.array()).all() &&
                          (goal.array() <= last.array()).all() && options.bounds_m.contains(goal_m);
    goal_ = has_goal ? indexOf(goal.cast<int>() - least_) : -1;

    const auto cells = static_cast<std::size_t>(size_.prod());
    Memory& kept = memory();
    if (kept.cells.size() < cells) kept.cells.resize(cells);
    if (++kept.search == 0) {  // overflow after 2^32 searches
        std::fill(kept.cells.begin(), kept.cells.end(), Cell{});
        kept.search = 1;
    }
    number_ = kept.search;
    for (std::size_t axes = 0; axes < 4; ++axes) {
        lengths_[axes] =
            std::llround(kCostPerMetre * options.cell_m * std::sqrt(static_cast<double>(axes)));
    }
}

Cell& Search::cell(int index) {
    Cell& cell = cells_[static_cast<std::size_t>(index)];
    if (cell.search != number_) {
        cell = {number_, -1, std::numeric_limits<Cost>::max(), 0, 0, -1, false};
    }
    return cell;
}

Eigen::Vector3i Search::placeOf(int index) const {
    const int row = index / size_.x();
    return {index % size_.x(), row % size_.y(), row / size_.y()};
}

/// Point 0 is the cell's centre, 1 to 4 are beside it. Start and goal are passed at their
/// positions.
Eigen::Vector3d Search::pointOf(int index, int place) const {
    if (index == start_) return start_m_;
    if (index == goal_) return goal_m_;
    const Eigen::Vector3d centre_m =
        options_.anchor_m + options_.cell_m * (placeOf(index) + least_).cast<double>();
    if (place == 0) return centre_m;
    const double beside_m = options_.cell_m / 4;
    return centre_m +
           Eigen::Vector3d(place & 1 ? beside_m : -beside_m, place > 2 ? beside_m : -beside_m, 0);
}

void Search::look(int index) {
    Cell& at = cell(index);
    if (at.place != -1) return;
    const double least_m = options_.min_clearance_m;
    at.place = 0;
    at.clearance_m = clearance_m_(pointOf(index, 0).cast<float>());
    // Clearance is 1-Lipschitz, so only near misses need more queries.
    const double beside_m = options_.cell_m / 4 * std::sqrt(2.0);
    if (at.clearance_m < least_m && at.clearance_m + beside_m >= least_m && index != start_ &&
        index != goal_) {
        for (std::int8_t place = 1; place <= 4; ++place) {
            const float there_m = clearance_m_(pointOf(index, place).cast<float>());
            if (there_m > at.clearance_m) {
                at.clearance_m = there_m;
                at.place = place;
            }
        }
    }
    const double height_m = pointOf(index, at.place).z();
    at.extra_permille = std::llround(1000 * extraCost(at.clearance_m, height_m, options_));
}

/// Whether the edge between two expanded cells is free. If the start is too close to an obstacle,
/// clearance must grow.
bool Search::mayPass(int from, int to) {
    const Cell &a = cell(from), &b = cell(to);
    const double ends_m = std::min(a.clearance_m, b.clearance_m);
    const double least_m = std::min(options_.min_clearance_m - kGrazing_m, ends_m);
    if (b.clearance_m < options_.min_clearance_m && !(b.clearance_m > a.clearance_m)) {
        return false;
    }
    const Eigen::Vector3d start_m = pointOf(from, a.place);
    const Eigen::Vector3d offset_m = pointOf(to, b.place) - start_m;
    const double length_m = offset_m.norm();
    double at_m = std::max(a.clearance_m - least_m, kCheckStep_m);
    const double end_m = length_m - std::max(b.clearance_m - least_m, kCheckStep_m);
    while (at_m < end_m) {
        const Eigen::Vector3d point_m = start_m + at_m / length_m * offset_m;
        const double clearance_m = clearance_m_(point_m.cast<float>());
        if (clearance_m < least_m) return false;
        at_m += std::max(clearance_m - least_m, kCheckStep_m);
    }
    return true;
}

Cost Search::costOfStep(int from, int to) const {
    const Cell &a = cells_[static_cast<std::size_t>(from)],
               &b = cells_[static_cast<std::size_t>(to)];
    const int axes = static_cast<int>((placeOf(from) - placeOf(to)).array().abs().sum());
    const Cost length = lengths_[static_cast<std::size_t>(axes)];
    return length + length * (a.extra_permille + b.extra_permille) / 2000;
}

/// The distance through empty space on a grid with diagonals, times the heuristic weight.
Cost Search::leastCostToGoal(const Eigen::Vector3i& place) const {
    std::array<int, 3> steps{};
    const Eigen::Vector3i goal = placeOf(goal_);
    for (int axis = 0; axis < 3; ++axis) {
        steps[static_cast<std::size_t>(axis)] = std::abs(place[axis] - goal[axis]);
    }
    std::sort(steps.begin(), steps.end());
    const Cost way = lengths_[3] * steps[0] + lengths_[2] * (steps[1] - steps[0]) +
                     lengths_[1] * (steps[2] - steps[1]);
    return way * heuristic_permille_ / 1000;
}

void Search::push(int from, int to, const Eigen::Vector3i& place, Cost length) {
    Cell& there = cell(to);
    if (there.is_closed) return;
    const Cell& here = cell(from);
    const bool was_seen = there.place != -1;
    const Cost step =
        was_seen ? costOfStep(from, to) : length + length * here.extra_permille / 2000;
    const Cost cost = here.cost + step;
    if (cost >= there.cost) return;
    entries_.push_back({cost + leastCostToGoal(place), cost, to, from, false});
    std::push_heap(entries_.begin(), entries_.end());
}

void Search::open(int index) {
    cell(index).is_closed = true;
    const Eigen::Vector3i place = placeOf(index);
    for (int z = -1; z <= 1; ++z) {
        for (int y = -1; y <= 1; ++y) {
            for (int x = -1; x <= 1; ++x) {
                const Eigen::Vector3i next = place + Eigen::Vector3i(x, y, z);
                if ((next.array() < 0).any() || (next.array() >= size_.array()).any()) continue;
                const auto axes = static_cast<std::size_t>(std::abs(x) + std::abs(y) + std::abs(z));
                if (axes > 0) push(index, indexOf(next), next, lengths_[axes]);
            }
        }
    }
}

std::vector<Eigen::Vector3d> Search::pathTo(int index) const {
    std::vector<Eigen::Vector3d> path_m;
    for (int at = index; at >= 0; at = cells_[static_cast<std::size_t>(at)].parent) {
        path_m.push_back(pointOf(at, cells_[static_cast<std::size_t>(at)].place));
    }
    std::reverse(path_m.begin(), path_m.end());
    return path_m;
}

std::optional<std::vector<Eigen::Vector3d>> Search::run() {
    if (goal_ < 0) return std::nullopt;
    if (start_ == goal_) return std::vector<Eigen::Vector3d>{start_m_, goal_m_};
    look(goal_);
    if (cell(goal_).clearance_m < options_.min_clearance_m) return std::nullopt;
    look(start_);
    cell(start_).cost = 0;
    open(start_);
    int opened = 1;
    while (!entries_.empty() && opened < options_.max_cells) {
        std::pop_heap(entries_.begin(), entries_.end());
        Entry entry = entries_.back();
        entries_.pop_back();
        Cell& at = cell(entry.cell);
        if (at.is_closed || (!entry.is_exact && entry.cost >= at.cost)) continue;
        if (!entry.is_exact) {
            look(entry.cell);
            const Cost cost = cell(entry.parent).cost + costOfStep(entry.parent, entry.cell);
            if (cost >= at.cost || !mayPass(entry.parent, entry.cell)) continue;
            at.cost = cost;
            at.parent = entry.parent;
            const Cost more = cost - entry.cost;
            if (more > 0) {
                entries_.push_back({entry.estimate + more, cost, entry.cell, entry.parent, true});
                std::push_heap(entries_.begin(), entries_.end());
                continue;
            }
        } else if (entry.cost > at.cost) {
            continue;
        }
        if (entry.cell == goal_) return pathTo(goal_);
        open(entry.cell);
        ++opened;
    }
    return std::nullopt;
}

}  // namespace

std::optional<std::vector<Eigen::Vector3d>> findPath(const Clearance& clearance_m,
                                                     const Eigen::Vector3d& start_m,
                                                     const Eigen::Vector3d& goal_m,
                                                     const PathSearchOptions& options) {
    return Search(clearance_m, start_m, goal_m, options).run();
}

}  // namespace hagen::avoidance
