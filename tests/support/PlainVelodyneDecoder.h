#pragma once
#include <hagen/range_image/Scan.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <cstddef>

namespace hagen::test {

/// decodePackets() return by return, each direction from a table of all azimuths: what the library
/// does fast. All packets are to be of one known model.
std::size_t decodePlainly(const mrpt::obs::CObservationVelodyneScan& observation, Scan& scan);

}  // namespace hagen::test
