#pragma once
#include <hagen/scan/Scan.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <cstddef>

namespace hagen::test {

/// Reference implementation of decodePackets(): return by return, each direction from a table of
/// all azimuths. All packets must be from one known model.
std::size_t decodePlainly(const mrpt::obs::CObservationVelodyneScan& observation, Scan& scan);

}  // namespace hagen::test
