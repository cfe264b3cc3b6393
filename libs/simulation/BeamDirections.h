#pragma once
#include <hagen/scan/SensorModel.h>
#include <hagen/simulation/Lidar.h>
#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

namespace hagen::simulation {

/// Where a laser points, in the sensor's frame.
struct BeamDirection {
    Eigen::Vector3f direction;
    float azimuth_rad;    ///< within +-pi
    float elevation_rad;  ///< above the sensor's xy plane
    std::uint8_t row;     ///< of the nearest beam of the sensor model
};

/// Writes the directions of a firing's lasers, in firing order, into a vector of their number.
using DirectionsOfFiring =
    std::function<void(int firing, std::vector<BeamDirection>& directions_of_lasers)>;

/// Returns the directions of the scan that begins `time_s` (>= 0) after the sensor's start.
///
/// A sensor with rings fires each of its beams in each firing, and every revolution is the same.
///
/// A Mid-360 is simulated with a pattern of our own that has the published figures: four lines,
/// 200 000 points per second, all round, elevations from -7 to 52 degrees, never the same again.
/// (The real pattern is not published.) All four lines turn clockwise together, 81 times per
/// second. Each sweeps up and down a quarter of the elevations, at constant speed (triangle wave),
/// 14.1 times per second. With t the time since the sensor's start, and l the line, 0 to 3:
///
///     azimuth   = 180 deg - 360 deg * frac(25 (1 + sqrt(5)) t / s)
///     elevation = -7 deg + 59 deg / 4 * (l + 1 - |2 frac(10 sqrt(2) t / s) - 1|)
///
/// The ratio of both frequencies is irrational: the pattern does not repeat, and over time it is
/// uniform in azimuth and elevation. Of 1 x 1.5 degree cells, a frame of 0.1 s meets 63 to 67 %,
/// two frames 96 %, three all.
DirectionsOfFiring directionsOfScan(const SensorModel& sensor, const FiringPattern& pattern,
                                    double time_s);

}  // namespace hagen::simulation
