#pragma once
#include <hagen/filter/ResultCheck.h>
#include <hagen/mrpt/MappedScan.h>
#include <hagen/mrpt/ObservationSegmenter.h>
#include <hagen/recordings/ScanSource.h>
#include <hagen/settings/Settings.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace hagen::avoidance {

/// A recorded log and the settings for segmenting its scans.
struct LogSource {
    std::filesystem::path log;    ///< a rawlog, a capture or a scan folder
    std::filesystem::path poses;  ///< pose file (TUM, KITTI); empty: poses in the log
    std::string sensor_label;     ///< LiDAR to use; empty: all LiDARs of the log
    Settings settings;
    float own_reach_m = 0.8f;  ///< nearer returns are from the vehicle and are dropped
    std::filesystem::path sensor_json = {};  ///< Ouster metadata for a capture; empty: none
    std::vector<std::string> topics = {};    ///< LiDAR topics of a bag; empty: all
};

/// A segmented scan of a log in the map frame.
struct LoggedScan {
    std::size_t entry = 0;  ///< index of the log entry (or folder scan), from 0
    observations::MappedScan mapped;
    Eigen::Vector3f vehicle_m{0, 0, 0};  ///< position of the vehicle at the end of the scan
    /// Returns have no times, or the poses end before the scan or have a gap within it.
    bool is_placed_by_one_pose = false;
    double filter_ms = 0;  ///< CPU time of this thread in the filter
};

/// The segmented scans of a log in order. Poses come from `poses` or, if empty, from the log; each
/// return is placed by the pose at its own time.
class LoggedScans {
 public:
    /// Reads poses and times. Throws recordings::Interrupted once `keep_going` returns false, and
    /// std::runtime_error, naming the file, if there are no scans or no poses, or if fewer than
    /// half of the scans have a pose; SettingsError for invalid settings.
    explicit LoggedScans(
        const LogSource& source, const std::function<bool()>& keep_going = [] { return true; });

    /// Reads the next scan with a pose; false at the end. Throws like ScanSource::nextScan(),
    /// including where the log is truncated. Skips unreadable scans.
    bool next(LoggedScan& scan);

    const std::string& poseSource() const { return source_->poses().source; }
    /// Whether the map's z axis points against gravity.
    bool posesHaveHorizon() const { return source_->poses().vehicle.has_horizon; }
    /// Number of scans in the log, and of scans skipped because they have no pose.
    std::size_t scans() const { return scans_; }
    std::size_t scansWithoutPose() const { return without_pose_; }
    /// Number of unreadable scans so far, and the first error.
    std::size_t unreadableScans() const { return unreadable_; }
    const std::string& whyUnreadable() const { return why_unreadable_; }
    /// Remarks about the log as a whole (ScanSource::remarks(), ResultCheck::warnings()).
    std::vector<std::string> remarks() const;
    /// Contains the vehicle's position at every scan.
    const Eigen::AlignedBox3f& flight_m() const { return flight_m_; }

 private:
    void placeAll(const std::vector<mrpt::Clock::time_point>& times, const std::string& log);

    std::unique_ptr<recordings::ScanSource> source_;
    observations::ObservationSegmenter segmenter_;
    ResultCheck check_;
    float own_reach_m_;
    std::size_t scans_ = 0, without_pose_ = 0, unreadable_ = 0;
    std::string why_unreadable_;
    Eigen::AlignedBox3f flight_m_;
};

}  // namespace hagen::avoidance
