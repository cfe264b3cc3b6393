#include "scan/AirframeLearner.h"
#include <hagen/scan/Angle.h>
#include <algorithm>
#include <cmath>
#include <deque>
#include <stdexcept>
#include <string>

namespace hagen {
namespace {

constexpr int kMinEdgeScans = 2;
constexpr double kMinEdgeShare = 0.02;

/// The nearest-rank quantile of ascending values.
float ranked(const std::vector<float>& ascending, double share) {
    return ascending[static_cast<std::size_t>(share * static_cast<double>(ascending.size() - 1))];
}

/// The share of the sphere that a bin covers.
double solidShareOf(int row, int rows) {
    const double step_rad = kPi / rows, low_rad = -0.5 * kPi + row * step_rad;
    return (std::sin(low_rad + step_rad) - std::sin(low_rad)) / (4.0 * rows);
}

}  // namespace

AirframeLearner::AirframeLearner(const AirframeRules& rules)
    : rules_(rules),
      near_(static_cast<std::size_t>(2 * rules.rows * rules.rows)),
      is_seen_(near_.size(), false) {}

void AirframeLearner::add(const Scan& scan) {
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const float range_m = scan.range_m[i];
        if (!(range_m > 0 && std::isfinite(range_m))) continue;
        const AirframeBin at = airframeBinOf({scan.x_m[i], scan.y_m[i], scan.z_m[i]}, rules_.rows);
        const auto bin = static_cast<std::size_t>(at.column * rules_.rows + at.row);
        is_seen_[bin] = true;
        if (range_m < rules_.near_m) near_[bin].push_back({scans_, range_m});
    }
    ++scans_;
}

LearnedAirframe AirframeLearner::learn() const {
    if (scans_ < rules_.min_scans) {
        throw std::invalid_argument(
            "has " + std::to_string(scans_) + (scans_ == 1 ? " scan" : " scans") + "; at least " +
            std::to_string(rules_.min_scans) + " are needed to learn the airframe");
    }
    const int rows = rules_.rows, columns = 2 * rows;
    const auto nearOf = [&](int row, int column) -> const std::vector<NearReturn>& {
        return near_[static_cast<std::size_t>(column * rows + row)];
    };
    /// Number of scans with near returns up to this range; returns are ordered by scan.
    const auto scansWithin = [](const std::vector<NearReturn>& returns, float range_m) {
        int scans = 0, last = -1;
        for (const NearReturn& near : returns) {
            if (near.range_m > range_m || near.scan == last) continue;
            last = near.scan;
            ++scans;
        }
        return scans;
    };

    LearnedAirframe learned;
    learned.bin_range_m = Image<float>::Zero(rows, columns);
    std::deque<AirframeBin> edges;
    for (int column = 0; column < columns; ++column) {
        for (int row = 0; row < rows; ++row) {
            const std::vector<NearReturn>& returns = nearOf(row, column);
            if (scansWithin(returns, rules_.near_m) < rules_.min_share * scans_) continue;
            std::vector<float> ranges_m;
            for (const NearReturn& near : returns) ranges_m.push_back(near.range_m);
            std::sort(ranges_m.begin(), ranges_m.end());
            const float farthest_m = ranked(ranges_m, 0.9);
            if (farthest_m - ranked(ranges_m, 0.1) > rules_.max_spread_m) continue;
            learned.bin_range_m(row, column) = farthest_m + rules_.margin_m;
            edges.push_back({row, column});
        }
    }
    while (!edges.empty()) {
        const AirframeBin from = edges.front();
        edges.pop_front();
        const float range_m = learned.bin_range_m(from.row, from.column);
        for (int row = std::max(from.row - 1, 0); row <= std::min(from.row + 1, rows - 1); ++row) {
            for (int step = -1; step <= 1; ++step) {
                const int column = wrapColumn(from.column + step, columns);
                if (learned.bin_range_m(row, column) > 0) continue;
                const int scans = scansWithin(nearOf(row, column), range_m);
                if (scans < kMinEdgeScans || scans < kMinEdgeShare * scans_) continue;
                learned.bin_range_m(row, column) = range_m;
                edges.push_back({row, column});
            }
        }
    }

    double seen = 0;
    for (int column = 0; column < columns; ++column) {
        for (int row = 0; row < rows; ++row) {
            const double solid = solidShareOf(row, rows);
            if (is_seen_[static_cast<std::size_t>(column * rows + row)]) seen += solid;
            if (learned.bin_range_m(row, column) == 0) continue;
            ++learned.bins;
            learned.share_of_sphere += solid;
        }
    }
    if (seen > 0) learned.share_of_seen = learned.share_of_sphere / seen;
    return learned;
}

}  // namespace hagen
