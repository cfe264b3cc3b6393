#pragma once
#include <hagen/sensors/Datagram.h>

namespace hagen::test {

/// A datagram that is valid during the lifetime of `bytes`.
inline sensors::Datagram datagramOf(const std::string& bytes, std::int64_t time_ns = 0) {
    sensors::Datagram datagram;
    datagram.time_ns = time_ns;
    datagram.bytes = reinterpret_cast<const std::uint8_t*>(bytes.data());
    datagram.size = bytes.size();
    return datagram;
}

}  // namespace hagen::test
