// Hesai datagrams with arbitrary content.
#include <hagen/scan/SensorModel.h>

#include "fuzz/Target.h"
#include "sensors/hesai/HesaiPacket.h"
#include "support/HesaiPackets.h"

namespace hagen::fuzz {
namespace {

void decode(std::string_view input) {
    sensors::Datagram datagram;
    datagram.bytes = reinterpret_cast<const std::uint8_t*>(input.data());
    datagram.size = input.size();
    const auto packet = sensors::hesaiPacketOf(datagram);
    if (!packet) return;
    const SensorModel sensor = sensorModel(packet->model);
    Scan scan;
    appendReturns(*packet, sensor, packet->time_ns + 1, scan);
    require(packet->step() < 4500, "a step");
    checkLocated(scan, sensor);
}

Seeds packetSeeds() {
    return {test::hesaiPackets(32, 1, 1)[0], test::hesaiPackets(16, 2, 1, 35999)[0]};
}

const bool kAdded = add({"hesai_packets", decode, packetSeeds, {"\xee\xff"}, 1500});

}  // namespace
}  // namespace hagen::fuzz
