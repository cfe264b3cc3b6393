#pragma once
#include <hagen/range_image/Label.h>
#include <hagen/segmentation/Levelling.h>
#include <hagen/segmentation/PixelPoints.h>
#include <Eigen/Geometry>
#include <optional>

namespace hagen {

/// The transform from the sensor's frame to the ground's: z is the height above the plane that the
/// ground lies about, x and y run along it, the origin is on it below the sensor.
///
/// The plane is fitted to the lowest point of each cell of a grid (0.75 m, 40 m around) by
/// iteratively reweighted least squares; a cell weighs less the farther it is off the plane, above
/// it sooner than below, and the farther it is away. Of an image of 400 columns or more, so many
/// are left out evenly that 200 to 400 remain. No height of the sensor is assumed. `attitude` is
/// where the search starts: level ground seen so; a sensor that does not know its own finds tilts
/// of 15 degrees from zero.
/// Fewer than three cells with points: the frame of a level plane (by `attitude`) through the
/// lowest of them, or through the sensor where there is none.
Eigen::Isometry3f fitGroundFrame(const PixelPoints& pixels, const Attitude& attitude);

/// Whether what the frame was fitted to can be ground: the sensor is above it, it is tilted by less
/// than 45 degrees against the horizon (against the airframe, where the attitude is not known), and
/// at least 50 pixels are labelled ROU. High up, beside a tower or a
/// tree, no ground is seen; what is seen must not become it.
bool canBeGround(const Eigen::Isometry3f& ground_from_sensor,
                 const std::optional<Attitude>& attitude, const Image<Label>& labels);

/// The unit vector against gravity in the ground's frame; where the attitude is not known, the
/// ground's normal.
Eigen::Vector3f upwards(const Eigen::Isometry3f& ground_from_sensor,
                        const std::optional<Attitude>& attitude);

}  // namespace hagen
