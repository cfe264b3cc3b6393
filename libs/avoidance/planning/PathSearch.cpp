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
constexpr double kProximityCost_per_m = 2;  ///< extra cost per metre at the minimum clearance
constexpr double kSegmentStep_m = 0.1;
constexpr double kGrazing_m = 0.05;  ///< tolerance of edges between cells
constexpr std::int64_t kMaxCellsOfGrid = 30'000'000;

/// State of a cell, valid only if its search number is current. 32 bytes, because long searches are
/// dominated by fetching cells.
struct Cell {
    Cost cost;
    Cost extra_permille;  ///< extra cost per metre
    std::uint32_t search = 0;
    int parent;
    float clearance_m;
    std::int8_t place;  ///< passing point; -1: unknown, -2: none
    bool is_closed;
};

/// The 26 neighbours of a cell and the cell itself (number 13), in the order of their indices.
constexpr int kNeighbours = 27, kItself = 13;

/// A way into a cell. Ties of the estimate are broken by longer completed path, then queried
/// clearance, then lower cell, then lower parent. The rank packs all of these into bits, because
/// comparisons dominate searches.
struct QueueEntry {
    static constexpr int kParentBits = 5, kCellBits = 25, kLeftBits = 33;

    Cost estimate;
    std::uint64_t rank;

    /// `parent` is an index below kNeighbours. If the entry is not exact, the clearance was not
    /// queried yet, and the cost may be higher.
    QueueEntry(Cost estimate_of_all, Cost left, bool is_exact, int cell, int parent)
        : estimate(estimate_of_all),
          rank(((static_cast<std::uint64_t>(left) << 1 | (is_exact ? 0u : 1u)) << kCellBits |
                static_cast<std::uint64_t>(cell))
                   << kParentBits |
               static_cast<std::uint64_t>(parent)) {}

    int parent() const { return static_cast<int>(rank & ((1u << kParentBits) - 1)); }
    int cell() const { return static_cast<int>(rank >> kParentBits & ((1u << kCellBits) - 1)); }
    bool isExact() const { return (rank >> (kParentBits + kCellBits) & 1) == 0; }
    Cost left() const { return static_cast<Cost>(rank >> (kParentBits + kCellBits + 1)); }
    Cost cost() const { return estimate - left(); }

    bool operator>(const QueueEntry& other) const {
        return estimate != other.estimate ? estimate > other.estimate : rank > other.rank;
    }
};
static_assert(QueueEntry::kParentBits + QueueEntry::kCellBits + 1 + QueueEntry::kLeftBits == 64);
static_assert(kNeighbours <= 1 << QueueEntry::kParentBits);
static_assert(kMaxCellsOfGrid <= 1 << QueueEntry::kCellBits);

/// The best entry first.
using Queue = std::priority_queue<QueueEntry, std::vector<QueueEntry>, std::greater<>>;

double extraCost(double clearance_m, double height_m, const PathSearchOptions& options) {
    const double range_m = options.wanted_clearance_m - options.min_clearance_m;
    const double short_m = options.wanted_clearance_m - clearance_m;
    const double share = range_m > 0 ? std::clamp(short_m / range_m, 0.0, 1.0) : 0.0;
    return kProximityCost_per_m * share +
           options.height_cost_per_m * std::abs(height_m - options.wanted_height_m);
}

/// Reused by later searches, because clearing costs more than most searches.
struct Memory {
    std::vector<Cell> cells;
    std::uint32_t search = 0;
};
Memory& memory() {
    thread_local Memory memory;
    return memory;
}

/// The cost of a step of this length between two cells.
Cost costOfStep(Cost length, const Cell& a, const Cell& b) {
    return length + length * (a.extra_permille + b.extra_permille) / 2000;
}

class Search {
 public:
    Search(const Clearance& clearance_m, const Eigen::Vector3d& start_m,
           const Eigen::Vector3d& goal_m, const PathSearchOptions& options)
        : clearance_m_(clearance_m),
          start_m_(start_m),
          goal_m_(goal_m),
          options_(options),
          heuristic_permille_(std::llround(1000 * std::max(1.0, options.heuristic_weight))),
          cells_(memory().cells) {
        if (!(options.cell_m > 0) || options.bounds_m.isEmpty()) {
            throw std::invalid_argument("path search: cell size and bounds must not be empty");
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
        if (!((count.array() >= 1).all() && count.prod() <= double(kMaxCellsOfGrid))) {
            throw std::invalid_argument("path search: the bounds contain no cells, or too many");
        }
        min_ = first.cast<int>();
        size_ = count.cast<int>();
        start_ = indexOf(nearest(start_m).cast<int>() - min_);
        const Eigen::Vector3d goal = nearest(goal_m);
        const bool has_goal = (goal.array() >= first.array()).all() &&
                              (goal.array() <= last.array()).all() &&
                              options.bounds_m.contains(goal_m);
        goal_ = has_goal ? indexOf(goal.cast<int>() - min_) : -1;

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
        const double farthest = static_cast<double>(size_.cast<std::int64_t>().sum()) *
                                static_cast<double>(lengths_[1]) *
                                static_cast<double>(heuristic_permille_) / 1000;
        if (!(farthest < std::ldexp(1.0, QueueEntry::kLeftBits))) {
            throw std::invalid_argument("path search: the bounds are too large");
        }
        if (has_goal) goal_place_ = placeOf(goal_);
        for (int i = 0; i < kNeighbours; ++i) {
            const int x = i % 3 - 1, y = i / 3 % 3 - 1, z = i / 9 - 1;
            offsets_[static_cast<std::size_t>(i)] = (z * size_.y() + y) * size_.x() + x;
            neighbour_lengths_[static_cast<std::size_t>(i)] =
                lengths_[static_cast<std::size_t>(std::abs(x) + std::abs(y) + std::abs(z))];
        }
    }
    std::optional<std::vector<Eigen::Vector3d>> run() {
        if (goal_ < 0) return std::nullopt;
        if (start_ == goal_) return std::vector<Eigen::Vector3d>{start_m_, goal_m_};
        look(goal_);
        if (cell(goal_).clearance_m < options_.min_clearance_m) return std::nullopt;
        look(start_);
        cell(start_).cost = 0;
        open(start_);
        int opened = 1;
        while (!queue_.empty() && opened < options_.max_cells) {
            const QueueEntry entry = queue_.top();
            queue_.pop();
            const int index = entry.cell();
            Cell& at = cell(index);
            if (at.is_closed || (!entry.isExact() && entry.cost() >= at.cost)) continue;
            if (!entry.isExact()) {
                look(index);
                const auto parent = static_cast<std::size_t>(entry.parent());
                const int from = index + offsets_[parent];
                const Cell& before = cell(from);
                const Cost cost = before.cost + costOfStep(neighbour_lengths_[parent], before, at);
                if (cost >= at.cost || !mayPass(from, index)) continue;
                at.cost = cost;
                at.parent = from;
                const Cost more = cost - entry.cost();
                if (more > 0) {
                    queue_.emplace(entry.estimate + more, entry.left(), true, index,
                                   entry.parent());
                    continue;
                }
            } else if (entry.cost() > at.cost) {
                continue;
            }
            if (index == goal_) return pathTo(goal_);
            open(index);
            ++opened;
        }
        return std::nullopt;
    }

 private:
    Cell& cell(int index) {
        Cell& cell = cells_[static_cast<std::size_t>(index)];
        if (cell.search != number_) {
            cell = {std::numeric_limits<Cost>::max(), 0, number_, -1, 0, -1, false};
        }
        return cell;
    }
    Eigen::Vector3i placeOf(int index) const {
        const int row = index / size_.x();
        return {index % size_.x(), row % size_.y(), row / size_.y()};
    }
    int indexOf(const Eigen::Vector3i& place) const {
        return (place.z() * size_.y() + place.y()) * size_.x() + place.x();
    }
    /// Point 0 is the cell's centre, 1 to 4 are beside it. Start and goal use exact positions.
    Eigen::Vector3d pointOf(int index, int place) const {
        if (index == start_) return start_m_;
        if (index == goal_) return goal_m_;
        const Eigen::Vector3d centre_m =
            options_.anchor_m + options_.cell_m * (placeOf(index) + min_).cast<double>();
        if (place == 0) return centre_m;
        const double beside_m = options_.cell_m / 4;
        return centre_m + Eigen::Vector3d(place & 1 ? beside_m : -beside_m,
                                          place > 2 ? beside_m : -beside_m, 0);
    }
    void look(int index) {
        Cell& at = cell(index);
        if (at.place != -1) return;
        const double min_m = options_.min_clearance_m;
        at.place = 0;
        at.clearance_m = clearance_m_(pointOf(index, 0).cast<float>());
        // Clearance is 1-Lipschitz, so only near misses need more queries.
        const double beside_m = options_.cell_m / 4 * std::sqrt(2.0);
        if (at.clearance_m < min_m && at.clearance_m + beside_m >= min_m && index != start_ &&
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
    /// Whether the edge between two expanded cells is free. If the start is too close to an
    /// obstacle, clearance must grow.
    bool mayPass(int from, int to) {
        const Cell &a = cell(from), &b = cell(to);
        const double ends_m = std::min(a.clearance_m, b.clearance_m);
        const double min_m = std::min(options_.min_clearance_m - kGrazing_m, ends_m);
        if (b.clearance_m < options_.min_clearance_m && !(b.clearance_m > a.clearance_m)) {
            return false;
        }
        const Eigen::Vector3d start_m = pointOf(from, a.place);
        const Eigen::Vector3d offset_m = pointOf(to, b.place) - start_m;
        const double length_m = offset_m.norm();
        double at_m = std::max(a.clearance_m - min_m, kSegmentStep_m);
        const double end_m = length_m - std::max(b.clearance_m - min_m, kSegmentStep_m);
        while (at_m < end_m) {
            const Eigen::Vector3d point_m = start_m + at_m / length_m * offset_m;
            const double clearance_m = clearance_m_(point_m.cast<float>());
            if (clearance_m < min_m) return false;
            at_m += std::max(clearance_m - min_m, kSegmentStep_m);
        }
        return true;
    }
    /// The distance through empty space on a grid with diagonals, times the heuristic weight.
    Cost minCostToGoal(int x, int y, int z) const {
        x = std::abs(x - goal_place_.x());
        y = std::abs(y - goal_place_.y());
        z = std::abs(z - goal_place_.z());
        const int min = std::min({x, y, z}), max = std::max({x, y, z});
        const int middle = x + y + z - min - max;
        const Cost way =
            lengths_[3] * min + lengths_[2] * (middle - min) + lengths_[1] * (max - middle);
        return way * heuristic_permille_ / 1000;
    }
    /// Closes a cell and queues its neighbours.
    void open(int index) {
        cell(index).is_closed = true;
        const Cell here = cell(index);
        const Eigen::Vector3i place = placeOf(index);
        const Eigen::Vector3i first = (place.array() - 1).max(0);
        const Eigen::Vector3i last = (place.array() + 1).min(size_.array() - 1);
        for (int z = first.z(); z <= last.z(); ++z) {
            for (int y = first.y(); y <= last.y(); ++y) {
                for (int x = first.x(); x <= last.x(); ++x) {
                    const int neighbour =
                        9 * (z - place.z()) + 3 * (y - place.y()) + x - place.x() + kItself;
                    if (neighbour == kItself) continue;
                    const int next = index + offsets_[static_cast<std::size_t>(neighbour)];
                    const Cell& there = cell(next);
                    if (there.is_closed) continue;
                    const Cost length = neighbour_lengths_[static_cast<std::size_t>(neighbour)];
                    const bool was_seen = there.place != -1;
                    const Cost step = was_seen ? costOfStep(length, here, there)
                                               : length + length * here.extra_permille / 2000;
                    const Cost cost = here.cost + step;
                    if (cost >= there.cost) continue;
                    const Cost left = minCostToGoal(x, y, z);
                    const int back = kNeighbours - 1 - neighbour;
                    queue_.emplace(cost + left, left, false, next, back);
                }
            }
        }
    }
    std::vector<Eigen::Vector3d> pathTo(int index) const {
        std::vector<Eigen::Vector3d> path_m;
        for (int at = index; at >= 0; at = cells_[static_cast<std::size_t>(at)].parent) {
            path_m.push_back(pointOf(at, cells_[static_cast<std::size_t>(at)].place));
        }
        std::reverse(path_m.begin(), path_m.end());
        return path_m;
    }

    const Clearance& clearance_m_;
    const Eigen::Vector3d start_m_, goal_m_;
    const PathSearchOptions& options_;
    Eigen::Vector3i min_, size_;  ///< grid limits, in cells from the anchor
    int start_ = 0, goal_ = 0;
    std::uint32_t number_ = 0;
    Cost heuristic_permille_;
    std::vector<Cell>& cells_;
    Queue queue_;
    std::array<Cost, 4> lengths_{};  ///< length of a step along 1, 2 or 3 axes
    Eigen::Vector3i goal_place_{0, 0, 0};
    std::array<int, kNeighbours> offsets_{};             ///< index offset of each neighbour
    std::array<Cost, kNeighbours> neighbour_lengths_{};  ///< distance of each neighbour
};

}  // namespace

std::optional<std::vector<Eigen::Vector3d>> findPath(const Clearance& clearance_m,
                                                     const Eigen::Vector3d& start_m,
                                                     const Eigen::Vector3d& goal_m,
                                                     const PathSearchOptions& options) {
    return Search(clearance_m, start_m, goal_m, options).run();
}

}  // namespace hagen::avoidance
