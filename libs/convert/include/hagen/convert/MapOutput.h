#pragma once
#include <hagen/base/OutputPath.h>
#include <hagen/mrpt/ObservationSegmenter.h>
#include <hagen/mrpt/ScanMap.h>
#include <hagen/mrpt/Trajectory.h>
#include <mrpt/obs/CObservation.h>

#include <deque>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace hagen::convert {

/// A scan in the map frame.
struct PlacedScan {
    observations::MappedScan mapped;
    /// Whether all returns are placed with the scan's pose, because the times of returns are
    /// missing or invalid, or because the vehicle's poses end before the scan or have a gap.
    bool is_by_one_pose;
};

/// Places the classified returns of a scan, each with the pose at its own time if `vehicle` and the
/// scan provide it, otherwise with the scan's pose. Returns nullopt without a pose.
std::optional<PlacedScan> placeInMap(const observations::ObservationSegmenter::Output& segmented,
                                     const mrpt::obs::CObservation& observation,
                                     const observations::Trajectory& vehicle);

/// An OctoMap of the scans of a log, written to one or several files.
class MapOutput {
 public:
    /// Throws std::runtime_error naming a file that has an unknown map format or cannot be written,
    /// and std::invalid_argument if options are out of range.
    MapOutput(const std::vector<std::filesystem::path>& files,
              const observations::ScanMapOptions& options, bool overwrite);

    void insert(const observations::MappedScan& scan) { map_.insert(scan); }

    /// Writes the map under temporary names. A failed file does not affect the others.
    void write();
    /// Throws std::runtime_error naming the files that could not be written, after renaming the
    /// others into place.
    void commit();
    /// Keeps partial files; returns their names, separated by spaces. Throws like commit().
    std::string keepPartial();

 private:
    observations::ScanMap map_;
    void giveUp(const base::OutputPath& file, const std::string& why);
    void throwFailures() const;

    std::deque<base::OutputPath> files_;
    std::set<const base::OutputPath*> given_up_;
    std::string failures_;
};

}  // namespace hagen::convert
