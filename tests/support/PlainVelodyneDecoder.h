#pragma once
#include <hagen/scan/Scan.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <cstddef>

namespace hagen::test {

/// Reference implementation of decodePackets() that decodes return by return, with a table of the
/// directions of all azimuths. All packets must be from one known model.
std::size_t decodePlainly(const mrpt::obs::CObservationVelodyneScan& observation, Scan& scan);

}  // namespace hagen::test
