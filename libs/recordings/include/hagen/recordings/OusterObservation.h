#pragma once
#include <hagen/sensors/OusterFrames.h>
#include <hagen/sensors/OusterSensor.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <string>

namespace hagen::recordings {

/// The returns of a frame (sensors::scanOf()) as an observation with the label "ouster": a
/// LocatedCloud. Its time is that of the frame's first packet, its pose the way from the sensor's
/// base to the origin.
mrpt::obs::CObservationPointCloud::Ptr observationOf(const sensors::OusterFrame& frame,
                                                     const sensors::OusterSensor& sensor);

/// "64 packets in 2 turns, 16 columns missing": for remarks().
std::string textOf(const sensors::OusterFrames::Counts& counts);

}  // namespace hagen::recordings
