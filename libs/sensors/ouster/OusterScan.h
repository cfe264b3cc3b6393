#pragma once
#include <hagen/scan/Scan.h>
#include <cstddef>
#include <vector>
#include "sensors/SweepReader.h"
#include "sensors/ouster/OusterFrames.h"

namespace hagen::sensors {

/// The returns of a frame, column by column as they were measured, each with its beam and the time
/// since the first column. The origin is that of the sensor's beams (its lidar frame), the axes
/// those of the sensor: x forward, away from the connector. Pixels without a range and invalid
/// columns have no return.
Scan scanOf(const OusterFrame& frame, const OusterSensor& sensor);

/// The same of some columns only, in this order; times are since the first one of these. Reuses the
/// memory of `scan`.
void scanColumns(const OusterFrame& frame, const OusterSensor& sensor,
                 const std::vector<std::size_t>& columns, Scan& scan);

/// A frame as a sweep with the label "ouster".
LidarSweep sweepOf(const OusterFrame& frame, const OusterSensor& sensor);
/// "64 packets in 2 turns, 16 columns missing".
std::string textOf(const OusterFrames::Counts& counts);

}  // namespace hagen::sensors
