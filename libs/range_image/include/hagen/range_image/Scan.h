#pragma once
#include <hagen/range_image/SensorModel.h>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hagen {

/// The returns of one scan in the sensor's frame (x forward, y left, z up), an array a quantity.
/// All arrays have the same size, but for those marked optional, which may be empty.
struct Scan {
    std::vector<float> x_m, y_m, z_m;
    std::vector<float> intensity;  ///< 0..1
    std::vector<float> range_m;  ///< distance from the sensor; NaN where a coordinate is not finite
    std::vector<float> azimuth_rad;  ///< atan2(y, x) of the firing, counter-clockwise from x
    std::vector<std::uint8_t> row;   ///< image row: the beam, counted from the lowest
    std::vector<float> time_s;       ///< optional: time of the return since the scan's first firing

    std::size_t size() const { return x_m.size(); }
    void clear();
    void reserve(std::size_t returns);
};

/// Fills range, azimuth and row from the coordinates, where the sensor did not tell them
/// (section III-A: angle_x = asin(z / d), angle_y = atan2(y, x), closest beam).
/// A return with a coordinate that is not finite, or at the origin, gets range NaN.
void locateBeams(const SensorModel& sensor, Scan& scan);

}  // namespace hagen
