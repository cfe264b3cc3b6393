#pragma once
#include <hagen/simulation/Path.h>
#include <hagen/simulation/Terrain.h>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

namespace hagen::simulation {

/// Pose of the vehicle or the sensor in the map (x east, z up).
struct SensorPose {
    Eigen::Vector3d position_m;
    Eigen::Quaterniond attitude;  ///< from the body frame (x forward, z up) to the map
};

struct FlightSettings {
    double altitude_m = 2;      ///< above the ground
    double speed_m_s = 4;       ///< on straights; the bank limit reduces it in turns
    double tilt_sd_rad = 0.07;  ///< standard deviation of roll and pitch; 0: level flight
};

/// The flight of a multirotor along a path above rolling ground. Roll, pitch and yaw are sums of
/// slow waves; the vehicle banks up to 4 degrees in turns and pitches with airspeed.
class Flight {
 public:
    Flight(const Terrain& terrain, const Path& path, const FlightSettings& settings,
           std::uint64_t seed);

    /// Returns the pose `time_s` (>= 0) after take-off.
    SensorPose at(double time_s) const;

 private:
    struct Sway {
        double rad_s, phase, amplitude;
    };
    static double valueOf(const std::vector<Sway>& sways, double time_s);
    static std::vector<Sway> sways(double sd, double slowest_hz, double fastest_hz, Random& random);
    double curvatureAt(double way_m) const;
    double speedAt(double way_m) const;
    double arcLengthAt(double time_s) const;

    Terrain terrain_;
    Path path_;
    FlightSettings settings_;
    double lean_;  ///< scale of tilt caused by speed and turns
    std::vector<Sway> roll_, pitch_, yaw_, climb_;
    std::vector<double> lap_s_;  ///< time at each step of the lap
};

}  // namespace hagen::simulation
