#pragma once
#include <hagen/range_image/Label.h>
#include <hagen/segmentation/Levelling.h>
#include <hagen/segmentation/PixelPoints.h>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hagen {

/// The memory of fitGroundFrame(). Keep it from scan to scan, so that none is allocated; it carries
/// nothing over. Lists may be longer than their contents.
struct GroundFrameWorkspace {
    /// The points that the plane is fitted to, and their weights by distance. The last part of four
    /// is padded with points of weight 0.
    struct Points {
        std::vector<double> x_m, y_m, z_m, nearness;
        std::size_t size = 0;
    };

    std::vector<std::int32_t> cell, height;  ///< of each pixel; heights as bits that order alike
    std::vector<std::int64_t> lowest;    ///< for each cell: height, then index of its lowest pixel
    std::vector<std::int32_t> occupied;  ///< cells with a pixel
    Points points;
};

/// The transform from the sensor's frame to the ground's: z is the height above the mean plane of
/// the ground, x and y run along it, the origin is on it below the sensor.
///
/// The plane is fitted to the lowest point of each cell of a grid (0.75 m, 40 m around) by
/// iteratively reweighted least squares; a cell's weight falls with its distance from the plane,
/// faster above than below, and with its distance from the sensor. Images of 400 columns or more
/// are thinned out evenly to 200 to 400 columns. No height of the sensor is assumed. The search
/// starts from level ground as seen with `attitude`; without knowing its attitude, a sensor finds
/// tilts of 15 degrees from zero. With fewer than three cells with points: the frame of a level
/// plane (by `attitude`) through the lowest of them, or through the sensor where there is none.
Eigen::Isometry3f fitGroundFrame(const PixelPoints& pixels, const Attitude& attitude,
                                 GroundFrameWorkspace& work);

/// Whether what the frame was fitted to can be ground: the sensor is above it, it is tilted by less
/// than 45 degrees against the horizon (against the airframe, where the attitude is unknown), and
/// at least 50 pixels are labelled ROU. High up beside a tower or a tree no ground is seen, and
/// what is seen must not be taken for it.
bool canBeGround(const Eigen::Isometry3f& ground_from_sensor,
                 const std::optional<Attitude>& attitude, const Image<Label>& labels);

/// The unit vector against gravity in the ground's frame; where the attitude is unknown, the
/// ground's normal.
Eigen::Vector3f upwards(const Eigen::Isometry3f& ground_from_sensor,
                        const std::optional<Attitude>& attitude);

}  // namespace hagen
