#pragma once
#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>

#include <optional>

namespace hagen::observations {

/// The vehicle's attitude from log observations: CObservationRobotPose, and CObservationIMU with an
/// orientation (quaternion, otherwise roll and pitch).
class Horizon {
 public:
    /// Stores the attitude of an observation. Ignores other classes and invalid times.
    void see(const mrpt::obs::CObservation& observation);

    void forget() { vehicle_.reset(); }

    /// The latest rotation relative to the horizon if within 0.2 s of `time`. Position and heading
    /// are undefined.
    std::optional<mrpt::poses::CPose3D> at(mrpt::Clock::time_point time) const;

 private:
    std::optional<mrpt::poses::CPose3D> vehicle_;
    mrpt::Clock::time_point time_;
};

}  // namespace hagen::observations
