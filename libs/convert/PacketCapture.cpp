#include "convert/PacketCapture.h"

#include <hagen/sensors/CaptureFile.h>
#include "base/ReadFile.h"

namespace hagen::convert {

void PacketCapture::add(const std::string& sensor_label, sensors::Datagram datagram) {
    const auto number = static_cast<std::uint32_t>(ip_of_.size());
    datagram.from_ip = ip_of_.emplace(sensor_label, 0x0a000064 + number).first->second;
    datagram.to_ip = 0x0a000001;
    writer_.add(datagram);
}

std::size_t capturePackets(const std::filesystem::path& recording,
                           recordings::SourceOptions options, const std::filesystem::path& capture,
                           bool overwrite) {
    base::checkApart({capture}, {recording, options.sensor_json});
    PacketCapture output(capture, overwrite);
    std::size_t packets = 0;
    options.packet = [&](const std::string& label, const sensors::Datagram& datagram) {
        output.add(label, datagram);
        ++packets;
    };
    if (sensors::isCapture(recording)) base::failAt(recording, "is a capture already");
    const auto source = recordings::openRecording(recording, options);
    while (source->nextEntry()) {
    }
    if (packets == 0) {
        base::failAt(recording,
                     "has no packets of a LiDAR, only decoded scans; segment them with "
                     "rawlog-segment");
    }
    output.commit();
    return packets;
}

}  // namespace hagen::convert
