#pragma once
#include "sensors/ouster/OusterFrames.h"

#include <string>

namespace hagen::test {

/// Metadata of an Ouster with four beams and 64 columns, in packets of 16 columns.
std::string ousterJson(const std::string& profile = "RNG19_RFL8_SIG16_NIR16",
                       const std::string& serial = "992137000142");

/// The packets of a frame as in Ouster's manual and SDK, with the serial number of `sensor`.
std::vector<std::string> packetsOf(const sensors::OusterSensor& sensor,
                                   const sensors::OusterFrame& frame);

/// A frame of this sensor with random pixels, some without a return; all columns are valid.
sensors::OusterFrame randomFrame(const sensors::OusterSensor& sensor, std::uint16_t id);

}  // namespace hagen::test
