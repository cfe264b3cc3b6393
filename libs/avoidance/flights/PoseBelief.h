#pragma once
#include <hagen/avoidance/FlightConditions.h>
#include <hagen/simulation/Random.h>
#include <cstdint>
#include <vector>
#include "avoidance/flights/FlightTrace.h"

namespace hagen::avoidance {

/// The pose estimate of a vehicle.
///
///     none   the true pose
///     noise  off by 5 cm per axis and 0.5 degrees about each axis (standard deviations), drawn
///            every 0.1 s and interpolated linearly: independent matching of each scan
///     drift  off by 1 % of the distance flown, in one direction: odometry
///
/// The velocity is always exact.
class PoseBelief {
 public:
    PoseBelief(PoseError error, std::uint64_t seed);

    simulation::SensorPose at(const FlightTrace& trace, double time_s);
    /// Believed minus true position.
    Eigen::Vector3d offset_m(const FlightTrace& trace, double time_s);

 private:
    struct Knot {
        Eigen::Vector3d offset_m, rotation_rad;
    };
    Knot knotAt(double time_s);

    PoseError error_;
    simulation::Random random_;
    Eigen::Vector3d direction_{0, 0, 0};  ///< unit vector of the drift
    std::vector<Knot> knots_;             ///< noise samples, one per 0.1 s
};

}  // namespace hagen::avoidance
