#pragma once
#include <hagen/live/SectorDistances.h>

#include <array>
#include <cmath>

#include "fuzz/Target.h"

namespace hagen::fuzz {

/// Checks that each return of a sector has a label and near or stale directions are never free.
class SectorChecker {
 public:
    explicit SectorChecker(const SensorModel& sensor) : distances_(sensor) {}

    void take(const live::LabelledSector& sector) {
        require(sector.label.size() == sector.returns.size(), "a return has no label");
        for (std::size_t i = 0; i < sector.label.size(); ++i) {
            require(
                !std::isnan(sector.returns.range_m[i]) || sector.label[i] == Label::Unclassified,
                "what has no range is unclassified");
        }
        returns_ += sector.returns.size();
        distances_.take(sector);
        const double now_s = sector.first_time_s;
        const auto around = distances_.at(now_s);
        for (std::size_t i = 0; i < sector.label.size(); ++i) {
            if (sector.label[i] == Label::Roi) checkKnown(sector.returns, i, around);
        }
        for (const live::SectorDistances::Sector& direction : distances_.at(now_s + 0.4)) {
            require(direction.state == live::SectorDistances::State::Unknown,
                    "what is stale is known");
        }
    }
    std::size_t returns() const { return returns_; }

 private:
    static void checkKnown(const Scan& returns, std::size_t i,
                           const std::array<live::SectorDistances::Sector, 72>& around) {
        const float x_m = returns.x_m[i], y_m = returns.y_m[i];
        const float distance_m = Eigen::Vector2f(x_m, y_m).norm();
        if (!std::isfinite(distance_m)) return;
        const double clockwise_rad =
            -std::atan2(static_cast<double>(y_m), static_cast<double>(x_m));
        const double turned_deg =
            clockwise_rad / 0.017453292519943295 + (clockwise_rad < 0 ? 360 : 0);
        const double part = turned_deg / 5 - std::floor(turned_deg / 5);
        if (part < 1e-3 || part > 1 - 1e-3) return;  // may be rounded into a neighbouring direction
        const auto& direction = around[static_cast<std::size_t>(turned_deg / 5) % 72];
        require(direction.state == live::SectorDistances::State::Obstacle &&
                    direction.distance_m <= distance_m,
                "a direction with an obstacle has none, or one that is farther");
    }

    live::SectorDistances distances_;
    std::size_t returns_ = 0;
};

}  // namespace hagen::fuzz
