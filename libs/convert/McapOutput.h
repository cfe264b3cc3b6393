#pragma once
#include <hagen/base/OutputPath.h>
#include <hagen/mrpt/ObservationSegmenter.h>
#include <mrpt/obs/CObservation.h>
#include "convert/McapWriter.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "convert/CloudOutput.h"

namespace hagen::convert {

/// The name of a sensor in topics and frames of ROS: its label, with '_' for characters that are
/// not allowed there. The name begins with a letter and differs from the frames "map", "odom" and
/// "world".
std::string rosNameOf(const std::string& sensor_label);

/// Writes segmented scans as a ROS 2 MCAP (docs/rawlog-segment.md): for each LiDAR with the name
/// rosNameOf(), labelledTable(), boxesToDraw() and, if known, the sensor pose in the frame `map`,
/// also on /tf. All messages have the time of their scan.
class McapOutput {
 public:
    /// Throws std::runtime_error naming the file; see OutputPath.
    McapOutput(const std::filesystem::path& file, bool overwrite);

    /// Throws std::runtime_error naming the file if it cannot be written.
    void write(const observations::ObservationSegmenter::Output& segmented,
               const mrpt::obs::CObservation& observation);

    std::size_t scans() const { return scans_; }
    std::size_t points() const { return points_; }
    std::size_t boxes() const { return boxes_; }
    std::size_t messages() const { return writer_.messages(); }
    /// Messages for the user about changes.
    std::vector<std::string> remarks() const;

    /// Completes the file. Do not write afterwards.
    void finish() { writer_.close(); }
    /// Renames the file into place, if it contains scans.
    void commit();
    std::filesystem::path keepPartial() { return path_.keepPartial(); }

 private:
    struct Lidar {
        std::string name;
        std::uint16_t points, obstacles;
        std::optional<std::uint16_t> pose;  ///< set once a pose is known
    };
    Lidar& lidarOf(const std::string& sensor_label);
    std::int64_t stampOf(mrpt::Clock::time_point time);
    void writePose(const mrpt::poses::CPose3D& pose, std::int64_t time_ns, Lidar& lidar);

    base::OutputPath path_;
    McapWriter writer_;
    std::map<std::string, Lidar> lidars_;  ///< by sensor label
    std::set<std::string> names_;
    std::optional<std::uint16_t> tf_;
    std::size_t scans_ = 0, points_ = 0, boxes_ = 0, untimed_ = 0;
    CloudChanges changes_;
};

}  // namespace hagen::convert
