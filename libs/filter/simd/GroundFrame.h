#pragma once
#include <hagen/filter/Levelling.h>
#include <hagen/filter/PixelPoints.h>
#include <hagen/scan/Label.h>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace hagen {

/// Workspace of fitGroundFrame(). Reuse it between scans to avoid allocations; it has no state.
/// Lists may have unused entries at the end.
struct GroundFrameWorkspace {
    std::vector<std::int32_t> columns;  ///< image columns to fit the plane to
    /// The points to fit the plane to, and their weights by distance. The last of the four parts is
    /// padded with points of weight 0.
    struct Points {
        std::vector<double> x_m, y_m, z_m, nearness;
        std::size_t size = 0;
    };

    std::vector<std::int32_t> cell, height;  ///< per pixel; heights as order-preserving integers
    std::vector<std::int64_t> lowest;        ///< per cell, height and index of its lowest pixel
    std::vector<std::int32_t> occupied;      ///< cells with a pixel
    Points points;
};

constexpr float kNoLimit_m = std::numeric_limits<float>::infinity();

/// The transform from the sensor frame to the ground frame: z is the height above the mean plane of
/// the ground, x and y lie in it, the origin is on it below the sensor.
///
/// The plane is fitted to the lowest point of each cell of a grid (0.75 m cells, within 40 m) by
/// iteratively reweighted least squares. A cell's weight decreases with its distance from the
/// plane, faster above than below, and with its distance from the sensor. Images of 400 columns or
/// more are subsampled evenly to 200 to 400 columns, or to `columns`. The sensor height is not
/// assumed, but each round starts from a plane below the sensor: on the forest floor, most cells
/// contain only crowns. The search starts from ground that is level according to `attitude`;
/// without an attitude, it finds tilts of up to 30 degrees. With fewer than three occupied cells,
/// returns the frame of a level plane (by `attitude`) through the lowest point, or through the
/// sensor if there are no points. Points more than `max_m` above the sensor, by `attitude`, are
/// ignored.
Eigen::Isometry3f fitGroundFrame(const PixelPoints& pixels, const Attitude& attitude,
                                 GroundFrameWorkspace& work,
                                 const std::vector<std::int32_t>* columns = nullptr,
                                 float max_m = kNoLimit_m);

/// Whether the fitted plane may be ground: the sensor is at most 0.3 m below it (a vehicle may
/// stand in a hollow or among plants that hide the ground), tilted by less than 45 degrees relative
/// to the horizon (to the airframe if the attitude is unknown), and at least 20 pixels are labelled
/// ROU. High up next to a tower or tree, no ground is visible, and other surfaces must not be
/// mistaken for ground.
bool canBeGround(const Eigen::Isometry3f& ground_from_sensor,
                 const std::optional<Attitude>& attitude, const Image<Label>& labels);

/// The unit vector against gravity in the ground frame; the ground normal if the attitude is
/// unknown.
Eigen::Vector3f upwards(const Eigen::Isometry3f& ground_from_sensor,
                        const std::optional<Attitude>& attitude);

}  // namespace hagen
