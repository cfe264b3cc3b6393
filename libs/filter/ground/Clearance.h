#pragma once
#include <hagen/filter/Ground.h>
#include <hagen/filter/Levelling.h>
#include <hagen/scan/Image.h>
#include <hagen/scan/Label.h>
#include <optional>

namespace hagen {

/// The minimum height of the sensor above the ground.
struct Clearance {
    Eigen::Vector3f up;  ///< unit vector against gravity, in the ground frame
    float min_m = 0;     ///< 0 for no minimum

    /// Whether a point in the ground frame is too close.
    bool isViolatedBy(const Ground& ground, const Eigen::Vector3f& point_m) const {
        return min_m > 0 && up.dot(ground.from_sensor.translation() - point_m) < min_m;
    }
};

/// The unit vector against gravity, in the ground frame: from the attitude if known, otherwise the
/// ground normal if ground is visible, otherwise the sensor's z axis.
Eigen::Vector3f upwards(const Ground& ground, const std::optional<Attitude>& attitude);

/// Relabels ROU pixels that are too close as RoI. Requires ground.pixels of this scan.
void alarmLowGround(const Ground& ground, const Clearance& clearance, Image<Label>& labels);

}  // namespace hagen
