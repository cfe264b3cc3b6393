#pragma once
#include <hagen/convert/WriteCloud.h>
#include <hagen/mrpt/ObservationSegmenter.h>
#include <mrpt/obs/CObservation.h>
#include "convert/SensorFolders.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace hagen::convert {

/// The output kind: a folder of labelled clouds, or a folder of such folders.
extern const base::OutputKind kClouds;

/// Counts the changes made to clouds when they were written.
class CloudChanges {
 public:
    void add(const std::vector<std::string>& changes);
    /// Messages for the user, with the number of affected clouds unless all are affected.
    std::vector<std::string> texts(std::size_t all_clouds) const;

 private:
    std::map<std::string, std::size_t> clouds_;  ///< number of clouds by change
};

/// Writes labelled clouds, one file per scan and one folder per LiDAR if there are several.
class CloudOutput {
 public:
    /// Throws std::runtime_error naming the folder; see OutputPath.
    CloudOutput(const std::filesystem::path& folder, OutputFormat format, bool overwrite);

    /// Writes a scan as NAME.ply or NAME.pcd. Throws std::runtime_error naming the file.
    void write(const std::string& name, const observations::ObservationSegmenter::Output& segmented,
               const mrpt::obs::CObservation& observation);

    std::size_t files() const { return files_; }
    std::size_t points() const { return points_; }
    /// Messages for the user about changes in the files.
    std::vector<std::string> remarks() const { return changes_.texts(files_); }

    void commit() { folders_.commit(); }
    std::filesystem::path keepPartial() { return folders_.keepPartial(); }

 private:
    OutputFormat format_;
    SensorFolders folders_;
    std::size_t files_ = 0, points_ = 0;
    CloudChanges changes_;
};

}  // namespace hagen::convert
