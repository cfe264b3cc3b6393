#pragma once
#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>

#include <optional>

namespace hagen::observations {

/// How the vehicle was tilted, as a log tells it while it goes by. Two kinds of observation do: a
/// CObservationRobotPose, and a CObservationIMU that has an orientation (its quaternion, else roll
/// and pitch).
class Horizon {
 public:
    /// Remembers what an observation says; any other kind, and one without a time, says
    /// nothing.
    void see(const mrpt::obs::CObservation& observation);

    /// The vehicle's rotation against the horizon by the last one seen, where that is within 0.2 s
    /// of `time`. Position and heading mean nothing.
    std::optional<mrpt::poses::CPose3D> at(mrpt::Clock::time_point time) const;

 private:
    std::optional<mrpt::poses::CPose3D> vehicle_;
    mrpt::Clock::time_point time_;
};

}  // namespace hagen::observations
