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

/// A segmented scan in the map: each return by the pose at its own time where `vehicle` and the
/// scan tell it, else all by the pose at the scan's time; none where that is not known either.
std::optional<mapping::MappedScan> placeInMap(
    const observations::ObservationSegmenter::Output& segmented,
    const mrpt::obs::CObservation& observation, const observations::Trajectory& vehicle);

/// An OctoMap of the scans of a log, written to one or several files.
class MapOutput {
 public:
    /// Throws std::runtime_error, naming a file that is no map's or cannot be written;
    /// std::invalid_argument for options that are out of range.
    MapOutput(const std::vector<std::filesystem::path>& files,
              const mapping::ScanMapOptions& options, bool overwrite);

    void insert(const mapping::MappedScan& scan) { map_.insert(scan); }

    void write() const;  ///< to temporary names
    void commit();
    std::string keepPartial();  ///< the names that it has then, a blank before each

 private:
    mapping::ScanMap map_;
    std::deque<base::OutputPath> files_;
};

}  // namespace hagen::logs
