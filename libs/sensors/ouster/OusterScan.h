#pragma once
#include <hagen/scan/Scan.h>
#include <cstddef>
#include <vector>
#include "sensors/SweepReader.h"
#include "sensors/ouster/OusterFrames.h"

namespace hagen::sensors {

/// Returns a frame's returns in the order of measurement, column by column, with beam rows and
/// times since the first column. The origin is that of the lidar frame, the axes are those of the
/// sensor frame: x forward, away from the connector. Skips pixels without range and invalid
/// columns.
Scan scanOf(const OusterFrame& frame, const OusterSensor& sensor);

/// Like scanOf(), but for these columns in this order; times are relative to the first of them.
/// Reuses the memory of `scan`.
void scanColumns(const OusterFrame& frame, const OusterSensor& sensor,
                 const std::vector<std::size_t>& columns, Scan& scan);

/// Converts a frame to a sweep with the label "ouster".
LidarSweep sweepOf(const OusterFrame& frame, const OusterSensor& sensor);
/// Such as "64 packets in 2 turns, 16 columns missing".
std::string textOf(const OusterFrames::Counts& counts);

}  // namespace hagen::sensors
