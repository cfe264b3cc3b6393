#pragma once
#include <hagen/sensors/Datagram.h>

#include <cstddef>
#include <cstdint>

namespace hagen::sensors {

constexpr std::size_t kUdpHeader = 8;  ///< bytes

/// Bytes of a frame, read in network order (most significant byte first).
struct Bytes {
    const std::uint8_t* data = nullptr;
    std::size_t size = 0;

    unsigned at8(std::size_t i) const { return data[i]; }
    unsigned at16(std::size_t i) const { return at8(i) << 8 | at8(i + 1); }
    std::uint32_t at32(std::size_t i) const { return std::uint32_t{at16(i)} << 16 | at16(i + 2); }
    /// The bytes from `i` to the end; empty if `i` is beyond the end.
    Bytes from(std::size_t i) const { return i > size ? Bytes{} : Bytes{data + i, size - i}; }
    Bytes first(std::size_t count) const { return {data, count < size ? count : size}; }
};

struct IpPacket {
    enum class Kind {
        Udp,    ///< `content` is a UDP datagram or a fragment of a datagram
        Other,  ///< other traffic
        Cut     ///< truncated: shorter than its header says
    };
    Kind kind = Kind::Other;
    bool is_tagged = false;  ///< the frame has a VLAN tag
    IpAddress from_ip, to_ip;
    std::uint32_t id = 0;    ///< shared by all fragments of a datagram
    std::size_t offset = 0;  ///< position of the content in the datagram, bytes
    bool has_more = false;
    Bytes content;

    bool isFragment() const { return has_more || offset > 0; }
};

/// True if frames of this link type (LINKTYPE_*) can be read.
bool isKnownLink(int link_type);

/// Returns the IP packet in a frame of this link type.
IpPacket readFrame(int link_type, Bytes frame);

}  // namespace hagen::sensors
