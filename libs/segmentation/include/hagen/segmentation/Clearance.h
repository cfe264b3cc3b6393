#pragma once
#include <hagen/range_image/Image.h>
#include <hagen/range_image/Label.h>
#include <hagen/range_image/Scan.h>
#include <hagen/segmentation/Ground.h>
#include <hagen/segmentation/Levelling.h>
#include <optional>
#include <vector>

namespace hagen {

/// Against gravity, in the ground's frame: by the attitude where it is known, else the ground's
/// normal where ground is seen, else the sensor's own z axis. A unit vector.
Eigen::Vector3f upwards(const Ground& ground, const std::optional<Attitude>& attitude);

/// Makes RoI of the ground that comes too close: ROU pixels that lie less than `least_clearance_m`
/// below the sensor. 0: none.
void alarmLowGround(const Ground& ground, const Eigen::Vector3f& up, float least_clearance_m,
                    Image<Label>& labels);

/// The same of returns that are judged by themselves (FartherReturns.h): of those in `own_label`
/// that are ROU. It has an entry a return, or none at all.
void alarmLowGround(const Scan& scan, const Ground& ground, const Eigen::Vector3f& up,
                    float least_clearance_m, std::vector<Label>& own_label);

}  // namespace hagen
