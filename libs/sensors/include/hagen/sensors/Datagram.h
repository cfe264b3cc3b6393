#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

namespace hagen::sensors {

struct Datagram {
    std::int64_t time_ns = 0;              ///< reception time since 1970
    std::uint32_t from_ip = 0, to_ip = 0;  ///< IPv4
    std::uint16_t from_port = 0, to_port = 0;
    const std::uint8_t* bytes = nullptr;  ///< not owned by the datagram
    std::size_t size = 0;
};

/// An address in dotted notation: "10.0.0.101".
std::string ipText(std::uint32_t ip);

}  // namespace hagen::sensors
