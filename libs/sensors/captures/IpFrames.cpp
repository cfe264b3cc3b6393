#include "sensors/captures/IpFrames.h"

#include <algorithm>
#include <iterator>

namespace hagen::sensors {
namespace {

constexpr unsigned kIpv4 = 0x0800, kIpv6 = 0x86dd, kUdp = 17;
constexpr int kNull = 0, kEthernet = 1, kLoop = 108, kAnyDevice = 113, kAnyDevice2 = 276;
constexpr int kRawIp[] = {12, 14, 101, 228, 229};  // 12 and 14: DLT_RAW in old files

bool isIp(unsigned type) { return type == kIpv4 || type == kIpv6; }
bool isVlanTag(unsigned type) { return type == 0x8100 || type == 0x88a8 || type == 0x9100; }

/// Returns the IP packet in an Ethernet frame whose type is at `at`; empty for other protocols.
Bytes behindType(Bytes frame, std::size_t at, bool& is_tagged) {
    while (at + 2 <= frame.size && isVlanTag(frame.at16(at))) {
        is_tagged = true;
        at += 4;
    }
    return at + 2 <= frame.size && isIp(frame.at16(at)) ? frame.from(at + 2) : Bytes{};
}

bool isRawIp(int link_type) {
    return std::find(std::begin(kRawIp), std::end(kRawIp), link_type) != std::end(kRawIp);
}

Bytes ipOf(int link_type, Bytes frame, bool& is_tagged) {
    switch (link_type) {
        case kEthernet:
            return behindType(frame, 12, is_tagged);
        case kAnyDevice:
            return behindType(frame, 14, is_tagged);
        case kAnyDevice2:
            return frame.size >= 20 && isIp(frame.at16(0)) ? frame.from(20) : Bytes{};
        case kNull:
        case kLoop:
            return frame.from(4);
        default:
            return isRawIp(link_type) ? frame : Bytes{};
    }
}

/// Reads the IPv6 packet up to its UDP header or fragment.
void readIpv6(Bytes ip, IpPacket& packet) {
    constexpr std::size_t kHeader = 40, kFragmentHeader = 8;
    constexpr unsigned kHopByHop = 0, kRouting = 43, kFragment = 44, kDestination = 60;
    unsigned next = ip.size > 6 ? ip.at8(6) : kUdp;
    const auto isOption = [](unsigned header) {
        return header == kHopByHop || header == kRouting || header == kDestination;
    };
    if (next != kUdp && next != kFragment && !isOption(next)) return;
    packet.kind = IpPacket::Kind::Cut;
    if (ip.size < kHeader) return;
    // The length is 0 if the network card segmented the packet after the capture (TSO).
    const std::size_t total = ip.at16(4) == 0 ? ip.size : kHeader + ip.at16(4);
    if (total > ip.size) return;
    const auto long64 = [&](std::size_t at) {
        return std::uint64_t{ip.at32(at)} << 32 | ip.at32(at + 4);
    };
    packet.from_ip = {long64(8), long64(16)};
    packet.to_ip = {long64(24), long64(32)};
    Bytes rest = ip.first(total).from(kHeader);
    while (isOption(next) || next == kFragment) {
        if (rest.size < kFragmentHeader) return;
        const bool is_fragment = next == kFragment;
        next = rest.at8(0);
        if (is_fragment) {
            packet.id = rest.at32(4);
            packet.has_more = (rest.at16(2) & 1) != 0;
            packet.offset = rest.at16(2) & 0xfff8;
        }
        rest = rest.from(is_fragment ? kFragmentHeader : 8 * (rest.at8(1) + 1));
        if (is_fragment) break;
    }
    packet.kind = next == kUdp ? IpPacket::Kind::Udp : IpPacket::Kind::Other;
    packet.content = rest;
}

}  // namespace

bool isKnownLink(int link_type) {
    constexpr int kOthers[] = {kNull, kEthernet, kLoop, kAnyDevice, kAnyDevice2};
    return isRawIp(link_type) ||
           std::find(std::begin(kOthers), std::end(kOthers), link_type) != std::end(kOthers);
}

IpPacket readFrame(int link_type, Bytes frame) {
    IpPacket packet;
    const Bytes ip = ipOf(link_type, frame, packet.is_tagged);
    constexpr std::size_t kMinHeader = 20;
    if (ip.size > 0 && ip.at8(0) >> 4 == 6) readIpv6(ip, packet);
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
    packet.id = ip.at16(4);
    const unsigned flags_and_offset = ip.at16(6);
    packet.has_more = (flags_and_offset & 0x2000) != 0;
    packet.offset = 8 * (flags_and_offset & 0x1fff);
    packet.content = ip.first(total).from(header);
    return packet;
}

}  // namespace hagen::sensors
