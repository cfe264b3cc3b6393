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
    /// A sensor with rings.
    double azimuthStep_deg() const { return 360.0 * firing_period_us / 100e3; }
};

/// Returns the pattern of a VLP-16, HDL-32E, HDL-64E or Mid-360. Throws std::invalid_argument for
/// any other sensor; the message lists these four.
FiringPattern firingPattern(const SensorModel& sensor);

/// Error sources of a real sensor.
struct SensorErrorModel {
    double footprint_rad = 0.003;  ///< width of the beam's (square) footprint
    double min_noise_m = 0.015;    ///< standard deviation at near range; doubled if weak
    double half_range_m = 150;     ///< half of a grey wall's returns are lost here
    double lost = 0.005;           ///< fraction of returns lost at random
    /// One beam in 1 + 1 / mixed has a range between both surfaces at an edge.
    double mixed = 0.15;
    double dust_per_m = 1.5e-5;  ///< dust particles hit per metre of a beam
    bool airframe = true;        ///< whether legs and rotors of the vehicle occlude beams
};

/// Returns the default error sources; for a Mid-360, from its manual (Livox Mid-360 User Manual,
/// 2023): a standard deviation of 2 cm at 10 m and 80 % reflectivity, and 10 % of the returns lost
/// at 40 m and 10 % reflectivity. Its angular error (below 0.15 degrees) is not simulated.
SensorErrorModel sensorErrors(const SensorModel& sensor);

/// One revolution of the sensor, or one frame of a sensor without rings. Returns are in firing
/// order and, as from a real sensor, in the sensor frame at each return's own time.
struct SimulatedScan {
    Scan scan;
    std::vector<ObjectClass> kind;      ///< one entry per return
    std::vector<std::uint16_t> object;  ///< scene object number per return; 0: no object
    std::vector<std::int32_t> firing;
    std::vector<std::uint8_t> laser;
    SensorPose pose;        ///< of the sensor, at the first firing
    double altitude_m = 0;  ///< of the sensor above the ground, at the first firing

    std::size_t size() const { return scan.size(); }
};

/// The azimuth of a scan's first firing, clockwise from x (behind the sensor).
constexpr double kFirstAzimuth_deg = 180.0;

/// The vehicle's pose as a function of time.
using PoseAt = std::function<SensorPose(double time_s)>;

/// Time beyond the end of a revolution for which poses are needed, for interpolation.
constexpr double kPosesBeyondTurn_s = 0.015;

/// Simulates the revolution that begins at `time_s`, by a sensor at the vehicle's origin.
///
/// Each beam is one ray at a random position in its footprint, so that the probability of hitting a
/// thin object is the covered fraction of the footprint. On a large surface the range is measured
/// along the beam's axis. Weak returns (range, incidence, reflectivity) are lost more often. On
/// grass, ranges end up to the grass height above the soil.
///
/// `mount` rotates from the sensor's frame to the vehicle's (x forward, z up). Legs and rotors are
/// fixed to the vehicle. The directions of a sensor without rings (Mid-360) depend on `time_s`.
SimulatedScan simulateScan(const Scene& scene, const SensorModel& sensor, const PoseAt& pose_at,
                           double time_s, Random& random, const SensorErrorModel& faults = {},
                           const Eigen::Quaterniond& mount = Eigen::Quaterniond::Identity());
SimulatedScan simulateScan(const Scene& scene, const SensorModel& sensor, const Flight& flight,
                           double time_s, Random& random, const SensorErrorModel& faults = {},
                           const Eigen::Quaterniond& mount = Eigen::Quaterniond::Identity());

/// Firings of a revolution in [first, end).
struct FiringRange {
    int first, end;
};

/// Like simulateScan() for a part of the revolution that begins at `time_s`. Requires poses until
/// kPosesBeyondTurn_s after the part. Parts draw separate random numbers, so they equal the whole
/// only without random errors. Throws std::invalid_argument for firings outside the pattern.
SimulatedScan simulateFirings(const Scene& scene, const SensorModel& sensor, const PoseAt& pose_at,
                              double time_s, const FiringRange& firings, Random& random,
                              const SensorErrorModel& faults = {},
                              const Eigen::Quaterniond& mount = Eigen::Quaterniond::Identity());

}  // namespace hagen::simulation
