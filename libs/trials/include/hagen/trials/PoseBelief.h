#pragma once
#include <hagen/simulation/Random.h>
#include <hagen/trials/FlightTrace.h>
#include <hagen/trials/Trial.h>
#include <cstdint>
#include <vector>

namespace hagen::trials {

/// Where a vehicle believes to be.
///
///     none   where it is
///     noise  off by 5 cm and by 0.5 degrees about each axis (standard deviations), drawn anew
///     every
///            0.1 s, and straight between: scan matching that sees each scan by itself
///     drift  off by 1 % of the way flown, in one direction: odometry
///
/// Its velocity it knows.
class PoseBelief {
 public:
    PoseBelief(PoseError error, std::uint64_t seed);

    simulation::SensorPose at(const FlightTrace& trace, double time_s);
    /// What is believed minus what is.
    Eigen::Vector3d offset_m(const FlightTrace& trace, double time_s);

 private:
    struct Knot {
        Eigen::Vector3d offset_m, rotation_rad;
    };
    Knot knotAt(double time_s);

    PoseError error_;
    simulation::Random random_;
    Eigen::Vector3d direction_{0, 0, 0};  ///< of the drift
    std::vector<Knot> knots_;             ///< of the noise, every 0.1 s
};

}  // namespace hagen::trials
