#pragma once
#include <mrpt/core/Clock.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DInterpolator.h>

#include <filesystem>
#include <optional>

namespace hagen {

/// Where the vehicle was: its poses in the map over time.
class Trajectory {
 public:
    Trajectory();

    void add(mrpt::Clock::time_point time, const mrpt::poses::CPose3D& vehicle_pose);

    /// The pose at a time, interpolated between the two poses around it; none where there are not
    /// two such within 0.2 s of one another, nor one of that very time.
    std::optional<mrpt::poses::CPose3D> at(mrpt::Clock::time_point time) const;

 private:
    mrpt::poses::CPose3DInterpolator poses_;
};

/// The poses that a rawlog tells: those of its CObservationRobotPose entries, alone or in sensory
/// frames. Reads the log once, to its end or its first break.
/// Throws std::runtime_error, naming the file, where it cannot be opened.
Trajectory readTrajectory(const std::filesystem::path& rawlog);

}  // namespace hagen
