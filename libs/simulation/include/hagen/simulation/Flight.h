#pragma once
#include <hagen/simulation/Path.h>
#include <hagen/simulation/Terrain.h>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

namespace hagen::simulation {

/// Where the sensor is, and how it is turned, in the map (x east, z up).
struct SensorPose {
    Eigen::Vector3d position_m;
    Eigen::Quaterniond attitude;  ///< from the sensor's frame (x forward, z up) to the map
};

struct FlightSettings {
    double altitude_m = 2;      ///< above the ground
    double speed_m_s = 4;       ///< on the straights; turns are flown as slowly as their bank asks
    double tilt_sd_rad = 0.07;  ///< standard deviation of roll and of pitch; 0: a level flight
};

/// A multirotor's flight along a path, at an altitude over rolling ground. It sways in roll, pitch
/// and yaw as a sum of slow waves, leans into turns (4 degrees at most) and against the air.
class Flight {
 public:
    Flight(const Terrain& terrain, const Path& path, const FlightSettings& settings,
           std::uint64_t seed);

    /// The pose at a time since take-off, from 0 on.
    SensorPose at(double time_s) const;

 private:
    struct Sway {
        double rad_s, phase, amplitude;
    };
    static double valueOf(const std::vector<Sway>& sways, double time_s);
    std::vector<Sway> sways(double sd, double slowest_hz, double fastest_hz, Random& random) const;
    double curvatureAt(double way_m) const;
    double speedAt(double way_m) const;
    double wayAt(double time_s) const;

    Terrain terrain_;
    Path path_;
    FlightSettings settings_;
    double lean_;  ///< share of the leaning that goes with speed and turns
    std::vector<Sway> roll_, pitch_, yaw_, climb_;
    std::vector<double> lap_s_;  ///< time at each metre of a lap
};

}  // namespace hagen::simulation
