#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <optional>

namespace hagen::avoidance {

/// The distance from `from_m` at which the straight way to `to_m` first has less clearance than
/// `min_m`, by sphere tracing with this minimum step; nullopt if the way is free.
template <class Clearance>
std::optional<double> blockedAt_m(const Clearance& clearance_m, const Eigen::Vector3d& from_m,
                                  const Eigen::Vector3d& to_m, double min_m,
                                  double min_step_m = 0.05) {
    const double length_m = (to_m - from_m).norm();
    for (double at_m = 0; at_m < length_m;) {
        const Eigen::Vector3d place_m = from_m + at_m / length_m * (to_m - from_m);
        const double spare_m = static_cast<double>(clearance_m(place_m.cast<float>())) - min_m;
        if (spare_m < 0) return at_m;
        at_m += std::max(min_step_m, spare_m);
    }
    return std::nullopt;
}

}  // namespace hagen::avoidance
