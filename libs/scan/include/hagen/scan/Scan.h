#pragma once
#include <hagen/scan/SensorModel.h>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hagen {

/// Summary of a sensor's beams, to detect rows that belong to another sensor.
struct BeamSpan {
    int rows = 0;                           ///< beams; 0: unknown
    float lowest_rad = 0, highest_rad = 0;  ///< elevations of the lowest and the highest beam
};
BeamSpan beamSpan(const SensorModel& sensor);

/// The returns of one scan in the sensor frame (x forward, y left, z up), one array per quantity.
/// All arrays have the same size; optional arrays may be empty.
struct Scan {
    std::vector<float> x_m, y_m, z_m;
    std::vector<float> intensity;  ///< 0..1
    std::vector<float> range_m;    ///< distance from the sensor; NaN if a coordinate is not finite
    std::vector<float> azimuth_rad;  ///< atan2(y, x) of the firing, counter-clockwise from x
    std::vector<std::uint8_t> row;   ///< image row: the beam, counted from the lowest
    std::vector<float> time_s;       ///< optional: time since the scan's first firing
    /// Optional: the beams that `row` refers to. Set by locateBeams().
    BeamSpan beams;

    std::size_t size() const { return x_m.size(); }
    void clear();
    void reserve(std::size_t returns);
};

/// Computes range, azimuth and row from the coordinates, for sensors that do not report them
/// (section III-A: angle_x = asin(z / d), angle_y = atan2(y, x), closest beam).
/// Returns at the origin or with non-finite coordinates get range NaN.
void locateBeams(const SensorModel& sensor, Scan& scan);

/// Throws std::invalid_argument, naming the function to call, unless every return has a range, an
/// azimuth, a row of this sensor, and finite coordinates or range NaN. Detects rows of another
/// sensor by `scan.beams` (a different number of beams, or a span that differs by more than 1
/// degree), and by rows that this sensor does not have.
void checkLocated(const Scan& scan, const SensorModel& sensor);

}  // namespace hagen
