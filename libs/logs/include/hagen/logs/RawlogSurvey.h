#pragma once
#include <hagen/observations/Trajectory.h>
#include <mrpt/core/Clock.h>
#include <mrpt/poses/CPose3D.h>

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace hagen::logs {

/// What has to be known of a rawlog before its first scan is segmented: a pose may come after the
/// scan that it is needed for.
struct RawlogSurvey {
    /// The vehicle's poses, by the best of the log's sources: CObservationRobotPose, else summed
    /// CActionRobotMovement3D, else CObservationOdometry, else summed CActionRobotMovement2D.
    /// Sources are not mixed, for each has a map of its own; of two alike (sensor labels) the one
    /// with more poses is taken.
    observations::Trajectory trajectory;
    std::string source;  ///< such as "CObservationRobotPose 'gps'"; empty where there are no poses

    /// When and from where on the vehicle each LiDAR scan was taken, by sensor label.
    struct ScanPlace {
        mrpt::Clock::time_point time;
        mrpt::poses::CPose3D sensor_on_vehicle;
    };
    std::map<std::string, std::vector<ScanPlace>> scans;
    bool is_whole = true;  ///< the log was read to its end
};

/// Reads a rawlog to its end or its first break (whoever converts it tells of that), or until
/// `keep_going` says no. Throws std::runtime_error, naming the file, where it cannot be opened.
///
/// An action without a time counts from the sensory frame that follows it.
RawlogSurvey surveyRawlog(
    const std::filesystem::path& rawlog,
    const std::function<bool()>& keep_going = [] { return true; });

}  // namespace hagen::logs
