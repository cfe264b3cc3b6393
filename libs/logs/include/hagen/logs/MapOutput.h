#pragma once
#include <hagen/base/OutputPath.h>
#include <hagen/mapping/ScanMap.h>
#include <hagen/observations/ObservationSegmenter.h>
#include <hagen/observations/Trajectory.h>
#include <mrpt/obs/CObservation.h>

#include <deque>
#include <filesystem>
#include <optional>
#include <vector>

namespace hagen::logs {

/// The classified returns of a scan in the map frame. Each is placed with the pose at its own time
/// if `vehicle` and the scan provide it, otherwise with the pose of the scan. None without a pose.
std::optional<mapping::MappedScan> placeInMap(
    const observations::ObservationSegmenter::Output& segmented,
    const mrpt::obs::CObservation& observation, const observations::Trajectory& vehicle);

/// An OctoMap of the scans of a log, written to one or several files.
class MapOutput {
 public:
    /// Throws std::runtime_error naming a file that has no map format or cannot be written,
    /// std::invalid_argument for options out of range.
    MapOutput(const std::vector<std::filesystem::path>& files,
              const mapping::ScanMapOptions& options, bool overwrite);

    void insert(const mapping::MappedScan& scan) { map_.insert(scan); }

    void write() const;  ///< to temporary names
    void commit();
    std::string keepPartial();  ///< returns the names of the partial files, each after a space

 private:
    mapping::ScanMap map_;
    std::deque<base::OutputPath> files_;
};

}  // namespace hagen::logs
