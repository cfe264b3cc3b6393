#pragma once
#include <hagen/range_image/Image.h>
#include <hagen/range_image/Label.h>
#include <hagen/segmentation/Ground.h>
#include <hagen/segmentation/Levelling.h>
#include <optional>

namespace hagen {

/// How far below the sensor the ground has to be.
struct Clearance {
    Eigen::Vector3f up;  ///< against gravity, in the ground's frame; a unit vector
    float least_m = 0;   ///< 0: any ground is far enough

    /// Whether a point in the ground's frame is too close.
    bool isViolatedBy(const Ground& ground, const Eigen::Vector3f& point_m) const {
        return least_m > 0 && up.dot(ground.from_sensor.translation() - point_m) < least_m;
    }
};

/// Against gravity, in the ground's frame: by the attitude where it is known, else the ground's
/// normal where ground is seen, else the sensor's own z axis. A unit vector.
Eigen::Vector3f upwards(const Ground& ground, const std::optional<Attitude>& attitude);

/// Turns ROU pixels into RoI where they are too close. Requires ground.pixels of this scan.
void alarmLowGround(const Ground& ground, const Clearance& clearance, Image<Label>& labels);

}  // namespace hagen
