#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

namespace hagen::sensors {

/// An IPv6 address, or an IPv4 address mapped to IPv6.
struct IpAddress {
    std::uint64_t high = 0, low = 0;

    IpAddress(std::uint32_t ipv4 = 0) : low(0xffff00000000 | ipv4) {}  // NOLINT: converts IPv4
    IpAddress(std::uint64_t first, std::uint64_t last) : high(first), low(last) {}
    bool isIpv4() const { return high == 0 && low >> 32 == 0xffff; }
    friend bool operator==(const IpAddress& a, const IpAddress& b) {
        return a.high == b.high && a.low == b.low;
    }
    friend bool operator!=(const IpAddress& a, const IpAddress& b) { return !(a == b); }
};

struct Datagram {
    std::int64_t time_ns = 0;  ///< reception time since 1970
    IpAddress from_ip, to_ip;
    std::uint16_t from_port = 0, to_port = 0;
    const std::uint8_t* bytes = nullptr;  ///< not owned by the datagram
    std::size_t size = 0;
};

/// An address in the usual notation: "10.0.0.101" or "fe80::1".
std::string ipText(const IpAddress& ip);

}  // namespace hagen::sensors
