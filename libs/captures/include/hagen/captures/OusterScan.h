#pragma once
#include <hagen/captures/OusterFrames.h>
#include <hagen/range_image/Scan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <cstddef>
#include <vector>

namespace hagen::captures {

/// The returns of a frame, column by column as they were measured, each with its beam and the time
/// since the first column. The origin is that of the sensor's beams (its lidar frame), the axes
/// those of the sensor: x forward, away from the connector. Pixels without a range and invalid
/// columns have no return.
Scan scanOf(const OusterFrame& frame, const OusterSensor& sensor);

/// The same of some columns only, in this order; times are since the first one of these. Reuses the
/// memory of `scan`.
void scanColumns(const OusterFrame& frame, const OusterSensor& sensor,
                 const std::vector<std::size_t>& columns, Scan& scan);

/// The same as an observation with the label "ouster": a LocatedCloud. Its time is that of the
/// frame's first packet, its pose the way from the sensor's base to the origin.
mrpt::obs::CObservationPointCloud::Ptr observationOf(const OusterFrame& frame,
                                                     const OusterSensor& sensor);

}  // namespace hagen::captures
