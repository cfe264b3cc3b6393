#pragma once
#include <hagen/scan/Scan.h>
#include <cstddef>
#include <vector>
#include "sensors/SweepReader.h"
#include "sensors/ouster/OusterFrames.h"

namespace hagen::sensors {

/// The returns of a frame in the order of measurement, column by column, each with its beam and the
/// time since the first column. The origin is the lidar frame's, the axes are the sensor frame's: x
/// forward, away from the connector. Pixels without a range and invalid columns have no return.
Scan scanOf(const OusterFrame& frame, const OusterSensor& sensor);

/// The same for these columns in this order; times are relative to the first of them. Reuses the
/// memory of `scan`.
void scanColumns(const OusterFrame& frame, const OusterSensor& sensor,
                 const std::vector<std::size_t>& columns, Scan& scan);

/// Converts a frame to a sweep with the label "ouster".
LidarSweep sweepOf(const OusterFrame& frame, const OusterSensor& sensor);
/// "64 packets in 2 turns, 16 columns missing".
std::string textOf(const OusterFrames::Counts& counts);

}  // namespace hagen::sensors
