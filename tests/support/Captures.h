#pragma once
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <filesystem>

namespace hagen::test {

/// The outdoor VLP-16 scan from Debian's mrpt-common; nullptr if not installed.
mrpt::obs::CObservationVelodyneScan::Ptr realVlp16Scan();

/// All data packets of a pcap capture as one observation, with this default calibration.
mrpt::obs::CObservationVelodyneScan::Ptr readCapture(const std::filesystem::path& pcap,
                                                     const char* calibration);

}  // namespace hagen::test
