#pragma once
#include <mrpt/obs/CObservation.h>
#include "sensors/SweepReader.h"

namespace hagen::recordings {

/// Converts a sweep to an observation: Velodyne packets to a CObservationVelodyneScan, other
/// returns to a LocatedCloud in a CObservationPointCloud. Its sensor pose is the beams' origin
/// relative to the sensor's base.
mrpt::obs::CObservation::Ptr observationOf(const sensors::LidarSweep& sweep);

}  // namespace hagen::recordings
