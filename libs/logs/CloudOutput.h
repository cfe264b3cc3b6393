#pragma once
#include <hagen/clouds/WriteCloud.h>
#include <hagen/logs/SensorFolders.h>
#include <hagen/observations/ObservationSegmenter.h>
#include <hagen/observations/PointTable.h>
#include <mrpt/obs/CObservation.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace hagen::logs {

/// A folder of labelled clouds, or a folder of such folders, as an output.
extern const base::OutputKind kClouds;
/// The file that tells such a folder from one with clouds of the user.
constexpr const char* kCloudsMarker = "made_by.txt";

/// The points of a segmented scan with their labels: all fields of the observation's cloud, or x,
/// y, z, intensity, `time` [s] if it is known, and of a sensor's own packets `ring`, counted from
/// the lowest beam; then `label` (uint8: 0 unclassified, 1 ROU, 2 RoI) and `obstacle` (uint32: the
/// RoI component, 0 none). All points of the input are there, in its order; those that were no
/// returns have the label 0. Fields of the input with one of these names become `input_label`,
/// `input_obstacle`.
observations::PointTable labelledTable(const observations::ObservationSegmenter::Output& segmented,
                                       const mrpt::obs::CObservation& observation);

/// The fields of a labelled table that were renamed, for the user.
std::vector<std::string> renamedFields(const observations::PointTable& labelled);

/// What was changed in clouds when they were written, and in how many.
class CloudChanges {
 public:
    /// The changes in one cloud.
    void add(const std::vector<std::string>& changes);
    /// For the user, with the number of clouds if these are not all.
    std::vector<std::string> texts(std::size_t all_clouds) const;

 private:
    std::map<std::string, std::size_t> clouds_;  ///< by change
};

/// Writes labelled clouds, one file per scan and one folder per LiDAR if there are several.
class CloudOutput {
 public:
    /// Throws std::runtime_error naming the folder; see OutputPath.
    CloudOutput(const std::filesystem::path& folder, clouds::OutputFormat format, bool overwrite);

    /// Writes a scan as NAME.ply or NAME.pcd. Throws std::runtime_error naming the file.
    void write(const std::string& name, const observations::ObservationSegmenter::Output& segmented,
               const mrpt::obs::CObservation& observation);

    std::size_t files() const { return files_; }
    std::size_t points() const { return points_; }
    /// What was changed in the files, for the user.
    std::vector<std::string> remarks() const { return changes_.texts(files_); }

    void commit() { folders_.commit(); }
    std::filesystem::path keepPartial() { return folders_.keepPartial(); }

 private:
    clouds::OutputFormat format_;
    SensorFolders folders_;
    std::size_t files_ = 0, points_ = 0;
    CloudChanges changes_;
};

}  // namespace hagen::logs
