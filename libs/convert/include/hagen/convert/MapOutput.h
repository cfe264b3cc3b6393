#pragma once
#include <hagen/mrpt/ObservationSegmenter.h>
#include <hagen/mrpt/ScanMap.h>
#include <hagen/mrpt/Trajectory.h>
#include <mrpt/obs/CObservation.h>
#include <optional>

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

}  // namespace hagen::convert
