#pragma once
#include <hagen/avoidance/Vehicle.h>
#include <hagen/simulation/Flight.h>
#include <vector>

namespace hagen::avoidance {

/// Position and tilt of a vehicle, one sample per kControlStep_s from time 0 on. Thrust provides
/// lift and acceleration, so the body tilts in every manoeuvre; the acceleration is smoothed over
/// kTilt_s, because a body takes time to rotate. The nose points along +x. The sensor is at the
/// centre of the body and aligned with it.
class FlightTrace {
 public:
    static constexpr double kTilt_s = 0.1;  ///< time constant of the tilt

    explicit FlightTrace(const VehicleState& start);

    /// Adds the state one control step later, and the acceleration that led to it.
    void add(const VehicleState& state, const Eigen::Vector3d& acceleration_m_s2);

    /// The sensor's true pose, clamped to the first and last sample.
    simulation::SensorPose at(double time_s) const;
    /// Distance flown up to a time.
    double distance_m(double time_s) const;

    /// Root mean square jerk of the smoothed acceleration.
    double rmsJerk_m_s3() const;

 private:
    struct Sample {
        simulation::SensorPose pose;
        Eigen::Vector3d smooth_m_s2;  ///< smoothed acceleration
        double distance_m;
    };
    struct Place {
        const Sample &before, &after;
        double share;
    };
    Place placeOf(double time_s) const;

    std::vector<Sample> samples_;
    double squared_jerk_ = 0;  ///< summed over all steps
};

}  // namespace hagen::avoidance
