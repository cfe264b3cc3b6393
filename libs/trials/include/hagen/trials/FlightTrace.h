#pragma once
#include <hagen/avoidance/Vehicle.h>
#include <hagen/simulation/Flight.h>
#include <vector>

namespace hagen::trials {

/// Where a vehicle under control was, a sample every kControlStep_s from time 0 on, and how it was
/// tilted: its thrust carries its weight and its acceleration, so that the body leans into what it
/// does; the acceleration is smoothed over kTilt_s, for a body does not turn at once. Its nose
/// stays towards +x. The sensor sits in the middle of the body, level with it.
class FlightTrace {
 public:
    static constexpr double kTilt_s = 0.1;  ///< time constant of the tilt

    explicit FlightTrace(const avoidance::VehicleState& start);

    /// The state a control step later, and the acceleration that led to it.
    void add(const avoidance::VehicleState& state, const Eigen::Vector3d& acceleration_m_s2);

    /// The sensor's true pose; before the first and after the last sample those.
    simulation::SensorPose at(double time_s) const;
    /// Length of the way flown until then.
    double way_m(double time_s) const;

    double end_s() const {
        return avoidance::kControlStep_s * static_cast<double>(samples_.size() - 1);
    }
    /// Root mean square of the smoothed acceleration's change.
    double rmsJerk_m_s3() const;

 private:
    struct Sample {
        simulation::SensorPose pose;
        Eigen::Vector3d smooth_m_s2;  ///< acceleration
        double way_m;
    };
    struct Place {
        const Sample &before, &after;
        double share;
    };
    Place placeOf(double time_s) const;

    std::vector<Sample> samples_;
    double squared_jerk_ = 0;  ///< sum over all steps
};

}  // namespace hagen::trials
