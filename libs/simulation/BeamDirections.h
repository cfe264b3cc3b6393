#pragma once
#include <hagen/scan/SensorModel.h>
#include <hagen/simulation/Lidar.h>
#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

namespace hagen::simulation {

/// The direction of a laser in the sensor frame.
struct BeamDirection {
    Eigen::Vector3f direction;
    float azimuth_rad;    ///< within +-pi
    float elevation_rad;  ///< above the sensor's xy plane
    std::uint8_t row;     ///< row of the nearest beam in the sensor model
};

/// Writes the directions of a firing's lasers, in firing order, to a vector of matching size.
using DirectionsOfFiring =
    std::function<void(int firing, std::vector<BeamDirection>& directions_of_lasers)>;

/// Returns the directions of the scan that begins `time_s` (>= 0) after the sensor started.
///
/// A sensor with rings fires all beams in each firing, and every revolution is the same.
///
/// A Mid-360 is simulated with our own pattern, because the real pattern is not published. It
/// matches real frames: four interleaved lines, 19 965 points per 0.1 s, 1.31 degrees of azimuth
/// between points of a line, elevations from -7.2 to 53.2 degrees, non-repeating. All four lines
/// rotate clockwise together at 182 Hz. Each line sweeps up and down a quarter of the elevations
/// at constant speed (triangle wave, from 0 to 1) at 14.1 Hz. For time t since the sensor started
/// and line l (0 to 3):
///
///     azimuth   = 180 deg - 360 deg * frac(105 sqrt(3) t / s)
///     elevation = -7.2 deg + 60.4 deg / 4 * (l + triangle(10 sqrt(2) t / s))
///
/// The ratio of both frequencies is irrational, so that the pattern does not repeat and, over time,
/// is uniform in azimuth and elevation. A frame of 0.1 s covers 82 to 83 % of 1 x 1.5 degree cells,
/// two frames 97 to 98 %, three 99.9 %. Indoors, real frames lack 28 % of the returns, in runs
/// longer than independent losses (2.4 instead of 1.4 points): those depend on the scene.
///
/// The patterns of the Avia and the HAP are our own, too, with the field of view, rate and (Avia)
/// number of lines of the manufacturer (Livox Avia User Manual, 2020; Livox HAP (TX) User Manual,
/// 2022): 70.4 x 77.2 degrees, 240 000 points per second from a vertical line of six lasers on a
/// rosette; 120 x 25 degrees, 452 000 points per second, here from four lines.
///
///     Avia: r = 35.2 deg * cos(2 pi 80 sqrt(2) t / s), a = 2 pi 10 sqrt(7) t / s
///           azimuth = r cos(a), elevation = r sin(a) + 6.8 deg * (l / 5 - 1 / 2)
///     HAP:  azimuth   = 60 deg - 120 deg * triangle(75 sqrt(3) t / s)
///           elevation = -12.5 deg + 25 deg / 4 * (l + triangle(20 sqrt(2) t / s))
///
/// A frame covers 61 % of the 0.5-degree cells of an Avia, two frames 86 %, three 93 %; HAP: 86 to
/// 100 %, two frames 100 %.
DirectionsOfFiring directionsOfScan(const SensorModel& sensor, const FiringPattern& pattern,
                                    double time_s);

}  // namespace hagen::simulation
