#pragma once
#include <hagen/range_image/Scan.h>
#include <hagen/range_image/SensorModel.h>
#include <hagen/simulation/Flight.h>
#include <hagen/simulation/Scene.h>
#include <functional>
#include <string>
#include <vector>

namespace hagen::simulation {

/// How a rotating LiDAR fires, as its manual tells.
struct FiringPattern {
    std::vector<std::uint8_t> row_of_laser;  ///< lasers in the order in which they fire
    double laser_period_us;                  ///< from one laser of a firing to the next
    double firing_period_us;                 ///< from one firing to the next
    int firings_per_turn;                    ///< at 10 turns a second

    double turnPeriod_s() const { return 1e-6 * firing_period_us * firings_per_turn; }
    double azimuthStep_deg() const { return 360.0 * firing_period_us / 100e3; }
};

/// Of a VLP-16, HDL-32E or HDL-64E. Throws std::invalid_argument, naming these, for others.
FiringPattern firingPattern(const SensorModel& sensor);

/// What keeps a real sensor from measuring the true range in every direction.
struct LidarFaults {
    double footprint_rad = 0.003;  ///< width of the beam's (square) spot
    double least_noise_m = 0.015;  ///< standard deviation of a near range; a weak one's is twice it
    double half_range_m = 150;   ///< where every second return of a grey wall, seen square, is lost
    double lost = 0.005;         ///< share of returns that are lost anyway
    double mixed = 0.15;         ///< share of beams whose range at an edge is between both
    double dust_per_m = 1.5e-5;  ///< specks met on a metre of a beam
    bool airframe = true;        ///< whether legs and rotors of the vehicle are seen
};

/// One turn of the sensor. Returns are in the order in which they were fired, in the sensor's frame
/// as it was at each return's own time, as a real sensor tells them.
struct SimulatedScan {
    Scan scan;
    std::vector<Kind> kind;             ///< an entry a return
    std::vector<std::uint16_t> object;  ///< its number in the scene; 0: none
    std::vector<std::int32_t> firing;
    std::vector<std::uint8_t> laser;
    SensorPose pose;        ///< at the first firing
    double altitude_m = 0;  ///< of the sensor above the ground, there

    std::size_t size() const { return scan.size(); }
};

/// The azimuth of a scan's first firing, degrees clockwise from x: scans begin behind.
constexpr double kFirstAzimuth_deg = 180.0;

/// Where the sensor is at a time.
using PoseAt = std::function<SensorPose(double time_s)>;

/// How far beyond the end of a turn a PoseAt is asked: it is sampled, and goes straight between.
constexpr double kPosesBeyondTurn_s = 0.015;

/// Simulates the turn that begins at `time_s`.
///
/// Each beam is one ray somewhere in its spot. So a thing thinner than the spot is met as often as
/// it covers the spot, and otherwise the beam goes on to what is behind. A broad surface is
/// measured where the beam's axis meets it. A return is lost the more often the weaker it is
/// (range, incidence, reflectivity). On grass, ranges end up to its height above the soil.
SimulatedScan simulateScan(const Scene& scene, const SensorModel& sensor, const PoseAt& pose_at,
                           double time_s, Random& random, const LidarFaults& faults = {});
SimulatedScan simulateScan(const Scene& scene, const SensorModel& sensor, const Flight& flight,
                           double time_s, Random& random, const LidarFaults& faults = {});

}  // namespace hagen::simulation
