#pragma once
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <hagen/simulation/Flight.h>
#include <hagen/simulation/Scene.h>
#include <functional>
#include <string>
#include <vector>

namespace hagen::simulation {

/// The firing sequence of a LiDAR, from its manual.
struct FiringPattern {
    /// Row of each laser, in firing order; empty for a sensor without rings.
    std::vector<std::uint8_t> row_of_laser;
    double laser_period_us;      ///< from one laser of a firing to the next
    double firing_period_us;     ///< from one firing to the next
    int firings_per_revolution;  ///< per scan, at 10 Hz
    int lasers;                  ///< per firing

    double revolutionPeriod_s() const { return 1e-6 * firing_period_us * firings_per_revolution; }
    /// Azimuth between firings. Only for sensors with rings.
    double azimuthStep_deg() const { return 360.0 * firing_period_us / 100e3; }
};

/// Returns the pattern of a VLP-16, HDL-32E, HDL-64E, Mid-360, Avia or HAP. Throws
/// std::invalid_argument listing these for other sensors.
FiringPattern firingPattern(const SensorModel& sensor);

/// Error sources of a real sensor.
struct SensorErrorModel {
    double footprint_rad = 0.003;  ///< width of the beam's square footprint
    double min_noise_m = 0.015;    ///< standard deviation at near range; doubled for weak returns
    double half_range_m = 150;     ///< range at which half of a grey wall's returns are lost
    double lost = 0.005;           ///< fraction of returns lost at random
    /// At edges, one beam in 1 + 1 / mixed has a range between the two surfaces.
    double mixed = 0.15;
    double dust_per_m = 1.5e-5;  ///< probability of hitting dust, per metre of a beam
    bool airframe = true;        ///< whether the vehicle's legs and rotors occlude beams
};

/// Returns the default error sources. For a Livox, they follow its manual (Mid-360: 2023, Avia:
/// 2020, HAP: 2022): a standard deviation of 2 cm at 10 m (Avia, HAP: 20 m) and 80 % reflectivity,
/// and 10 % of the returns lost at 40 m (190 m, 150 m) and 10 % reflectivity. Angular errors (below
/// 0.15 degrees) and the flat beams of Avia and HAP are not simulated.
SensorErrorModel sensorErrors(const SensorModel& sensor);

/// One revolution of the sensor, or one frame of a sensor without rings. Returns are in firing
/// order and, as in a real sensor, relative to the sensor's pose at each firing.
struct SimulatedScan {
    Scan scan;
    std::vector<ObjectClass> kind;
    std::vector<std::uint16_t> object;  ///< scene object of each return; 0: no object
    std::vector<std::int32_t> firing;
    std::vector<std::uint8_t> laser;
    SensorPose pose;        ///< sensor pose at the first firing
    double altitude_m = 0;  ///< height of the sensor above the ground at the first firing

    std::size_t size() const { return scan.size(); }
};

/// The azimuth of a scan's first firing (behind the sensor), clockwise from x.
constexpr double kFirstAzimuth_deg = 180.0;

/// The vehicle's pose as a function of time.
using PoseAt = std::function<SensorPose(double time_s)>;

/// Simulates the revolution that begins at `time_s`, with the sensor at the vehicle's origin.
///
/// Each beam is one ray at a random position in its footprint, so that the probability of hitting a
/// thin object is the fraction of the footprint that it covers. On large surfaces, the range is
/// measured along the beam's axis. Weak returns (due to range, incidence or reflectivity) are lost
/// more often. On grass, ranges end up to the grass height above the soil.
///
/// `mount` rotates from the sensor frame to the vehicle frame (x forward, z up). Legs and rotors
/// are fixed to the vehicle. The directions of a sensor without rings depend on `time_s`.
SimulatedScan simulateScan(const Scene& scene, const SensorModel& sensor, const PoseAt& pose_at,
                           double time_s, Random& random, const SensorErrorModel& faults = {},
                           const Eigen::Quaterniond& mount = Eigen::Quaterniond::Identity());
SimulatedScan simulateScan(const Scene& scene, const SensorModel& sensor, const Flight& flight,
                           double time_s, Random& random, const SensorErrorModel& faults = {},
                           const Eigen::Quaterniond& mount = Eigen::Quaterniond::Identity());

/// Firings [first, end) of a revolution.
struct FiringRange {
    int first, end;
};

/// Like simulateScan(), but for a part of the revolution that begins at `time_s`. Requires poses
/// until 15 ms after the part, for interpolation. Parts draw separate random numbers, so they equal
/// the whole revolution only without random errors. Throws std::invalid_argument for firings
/// outside the pattern.
SimulatedScan simulateFirings(const Scene& scene, const SensorModel& sensor, const PoseAt& pose_at,
                              double time_s, const FiringRange& firings, Random& random,
                              const SensorErrorModel& faults = {},
                              const Eigen::Quaterniond& mount = Eigen::Quaterniond::Identity());

}  // namespace hagen::simulation
