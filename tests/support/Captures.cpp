#include "support/Captures.h"

#include <hagen/recordings/RawlogReader.h>

#include <cstring>

#include "support/Program.h"

namespace hagen::test {

using mrpt::obs::CObservationVelodyneScan;

CObservationVelodyneScan::Ptr realVlp16Scan() {
    if (realScan().empty()) return nullptr;
    return std::dynamic_pointer_cast<CObservationVelodyneScan>(
        recordings::RawlogReader(realScan()).next());
}

CObservationVelodyneScan::Ptr readCapture(const std::filesystem::path& pcap,
                                          const char* calibration) {
    // A pcap file has a header of 24 bytes. A frame has 16 bytes, of which the last 8 are its
    // lengths, then 42 bytes of Ethernet, IP and UDP headers, then the packet.
    constexpr std::size_t kFileHeader = 24, kFrameHeader = 16, kNetworkHeaders = 42;
    const std::string bytes = readFile(pcap);
    auto scan = CObservationVelodyneScan::Create();
    for (std::size_t at = kFileHeader; at + kFrameHeader <= bytes.size();) {
        std::uint32_t length = 0;
        std::memcpy(&length, bytes.data() + at + 8, sizeof length);
        at += kFrameHeader;
        if (length == kNetworkHeaders + CObservationVelodyneScan::PACKET_SIZE) {
            auto& packet = scan->scan_packets.emplace_back();
            std::memcpy(static_cast<void*>(&packet), bytes.data() + at + kNetworkHeaders,
                        sizeof packet);
        }
        at += length;
    }
    scan->calibration = mrpt::obs::VelodyneCalibration::LoadDefaultCalibration(calibration);
    return scan;
}

}  // namespace hagen::test
