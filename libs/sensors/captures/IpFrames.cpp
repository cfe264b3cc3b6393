#include "sensors/captures/IpFrames.h"

#include <pcap/dlt.h>

#include <initializer_list>

namespace hagen::sensors {
namespace {

constexpr unsigned kIpv4 = 0x0800, kUdp = 17;
constexpr int kRawIp = 101;  // LINKTYPE_RAW, because the value of DLT_RAW differs between systems
constexpr int kAnyDevice2 = 276;

bool isVlanTag(unsigned type) { return type == 0x8100 || type == 0x88a8 || type == 0x9100; }

/// Returns the IP packet in an Ethernet frame whose type is at `at`; empty for other protocols.
Bytes behindType(Bytes frame, std::size_t at, bool& is_tagged) {
    while (at + 2 <= frame.size && isVlanTag(frame.at16(at))) {
        is_tagged = true;
        at += 4;
    }
    return at + 2 <= frame.size && frame.at16(at) == kIpv4 ? frame.from(at + 2) : Bytes{};
}

Bytes ipOf(int link_type, Bytes frame, bool& is_tagged) {
    switch (link_type) {
        case DLT_EN10MB:
            return behindType(frame, 12, is_tagged);
        case DLT_LINUX_SLL:
            return behindType(frame, 14, is_tagged);
        case kAnyDevice2:
            return frame.size >= 20 && frame.at16(0) == kIpv4 ? frame.from(20) : Bytes{};
        case DLT_NULL:
        case DLT_LOOP:
            return frame.from(4);
        default:
            return frame;  // raw IP
    }
}

}  // namespace

bool isKnownLink(int link_type) {
    for (const int known :
         {DLT_EN10MB, DLT_LINUX_SLL, kAnyDevice2, DLT_NULL, DLT_LOOP, DLT_RAW, DLT_IPV4, kRawIp}) {
        if (link_type == known) return true;
    }
    return false;
}

IpPacket readFrame(int link_type, Bytes frame) {
    IpPacket packet;
    const Bytes ip = ipOf(link_type, frame, packet.is_tagged);
    constexpr std::size_t kMinHeader = 20;
    if (ip.size == 0 || ip.at8(0) >> 4 != 4) return packet;
    const std::size_t header = 4 * (ip.at8(0) & 0xf);
    if (ip.size >= 10 && ip.at8(9) != kUdp) return packet;
    packet.kind = IpPacket::Kind::Cut;
    if (header < kMinHeader || ip.size < header) return packet;
    // The length is 0 if the network card segmented the packet after the capture (TSO).
    const std::size_t total = ip.at16(2) == 0 ? ip.size : ip.at16(2);
    if (total < header || total > ip.size) return packet;
    packet.kind = IpPacket::Kind::Udp;
    packet.from_ip = ip.at32(12);
    packet.to_ip = ip.at32(16);
    packet.id = static_cast<std::uint16_t>(ip.at16(4));
    const unsigned flags_and_offset = ip.at16(6);
    packet.has_more = (flags_and_offset & 0x2000) != 0;
    packet.offset = 8 * (flags_and_offset & 0x1fff);
    packet.content = ip.first(total).from(header);
    return packet;
}

}  // namespace hagen::sensors
