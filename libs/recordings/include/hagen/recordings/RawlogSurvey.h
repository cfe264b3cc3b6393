#pragma once
#include <hagen/mrpt/Trajectory.h>
#include <mrpt/core/Clock.h>
#include <mrpt/poses/CPose3D.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace hagen::recordings {

/// Information needed before the first scan of a rawlog is segmented. Poses may be stored after the
/// scans that need them.
struct RawlogSurvey {
    /// Vehicle poses from the best available source: CObservationRobotPose, then summed
    /// CActionRobotMovement3D, then CObservationOdometry, then summed CActionRobotMovement2D.
    /// Sources are not mixed, because each has its own map frame. If there are several sensor
    /// labels, the label with the most poses is used.
    observations::Trajectory trajectory;
    std::size_t not_finite = 0;  ///< number of skipped poses of all sources
    std::string source;  ///< such as "CObservationRobotPose 'gps'"; empty if there are no poses

    /// Time of each LiDAR scan, and the sensor's pose on the vehicle, by sensor label.
    struct ScanPlace {
        mrpt::Clock::time_point time;
        mrpt::poses::CPose3D sensor_on_vehicle;
    };
    std::map<std::string, std::vector<ScanPlace>> scans;
    std::size_t entries = 0;
    bool is_whole = true;     ///< whether the log was read to its end
    std::string break_found;  ///< error that ended reading; may be empty
};

/// Reads a rawlog to its end or until `keep_going` returns false. Stops without an error at an
/// unreadable entry, which the conversion reports. Throws std::runtime_error naming the file if it
/// cannot be opened.
///
/// Actions without a time get the time of the next sensory frame.
RawlogSurvey surveyRawlog(
    const std::filesystem::path& rawlog,
    const std::function<bool()>& keep_going = [] { return true; });

/// The times of all scans, by sensor label.
std::map<std::string, std::vector<mrpt::Clock::time_point>> scanTimesOf(const RawlogSurvey& survey);

/// Removes the scans of LiDARs that are not kept.
RawlogSurvey withScansOf(RawlogSurvey survey,
                         const std::function<bool(const std::string& sensor_label)>& isKept);

}  // namespace hagen::recordings
