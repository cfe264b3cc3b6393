#pragma once
#include <hagen/logs/ScanSource.h>
#include <hagen/mapping/MappedScan.h>
#include <hagen/observations/ObservationSegmenter.h>
#include <hagen/observations/Settings.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

namespace hagen::openloop {

/// A recorded log, and how its scans are to be segmented.
struct LogSource {
    std::filesystem::path log;    ///< a .rawlog, or a scan folder
    std::filesystem::path poses;  ///< where the vehicle was (TUM, KITTI); empty: what the log tells
    std::string sensor_label;     ///< of the LiDAR; empty: all of the log
    observations::Settings settings;
    float own_reach_m = 0.8f;  ///< nearer returns are the vehicle's own, and in no mapped scan
};

/// A segmented scan of a log, in the map.
struct LoggedScan {
    std::size_t entry = 0;  ///< of the log, from 0; of a scan folder: the scan
    mapping::MappedScan mapped;
    Eigen::Vector3f vehicle_m{0, 0, 0};  ///< where the vehicle was when the turn was complete
    bool is_moved_whole = false;  ///< placed by one pose: returns have no times, or poses end
    double filter_ms = 0;         ///< this thread's CPU time, of the filter alone
};

/// The scans of a log, segmented, one after the other. Poses are those of `poses`, else the log's
/// own; each return is placed by the pose at its own time.
class LoggedScans {
 public:
    /// Reads poses and times. Throws std::runtime_error, naming the file, where there are no scans,
    /// no poses, or fewer than half of the scans have one; SettingsError where settings do not fit.
    explicit LoggedScans(const LogSource& source);

    /// The next scan that has a pose; false at the end. Throws BrokenRawlog or BrokenScan where the
    /// log breaks off. A scan that cannot be read is left out.
    bool next(LoggedScan& scan);

    const std::string& poseSource() const { return source_->poses().source; }
    /// The map's z axis points against gravity.
    bool posesHaveHorizon() const { return source_->poses().vehicle.has_horizon; }
    /// Scans of the log, and those of them without a pose; they are left out.
    std::size_t scans() const { return scans_; }
    std::size_t scansWithoutPose() const { return without_pose_; }
    /// Scans met so far that could not be read, and why the last of them could not.
    std::size_t unreadableScans() const { return unreadable_; }
    const std::string& whyUnreadable() const { return why_unreadable_; }
    /// Contains the vehicle's position at every scan.
    const Eigen::AlignedBox3f& flight_m() const { return flight_m_; }

 private:
    void placeAll(const std::vector<mrpt::Clock::time_point>& times, const std::string& log);

    std::unique_ptr<logs::ScanSource> source_;
    observations::ObservationSegmenter segmenter_;
    float own_reach_m_;
    std::size_t scans_ = 0, without_pose_ = 0, unreadable_ = 0;
    std::string why_unreadable_;
    Eigen::AlignedBox3f flight_m_;
};

}  // namespace hagen::openloop
