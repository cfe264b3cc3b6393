#pragma once
#include <hagen/packets/OusterFrames.h>
#include <hagen/packets/OusterSensor.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <string>

namespace hagen::captures {

/// The returns of a frame (packets::scanOf()) as an observation with the label "ouster": a
/// LocatedCloud. Its time is that of the frame's first packet, its pose the way from the sensor's
/// base to the origin.
mrpt::obs::CObservationPointCloud::Ptr observationOf(const packets::OusterFrame& frame,
                                                     const packets::OusterSensor& sensor);

/// "64 packets in 2 turns, 16 columns missing": for remarks().
std::string textOf(const packets::OusterFrames::Counts& counts);

}  // namespace hagen::captures
