#include "live/mavlink/Frame.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "live/mavlink/Wire.h"

namespace hagen::mavlink {

std::uint16_t checksum(const std::uint8_t* bytes, std::size_t size, std::uint16_t crc) {
    for (std::size_t i = 0; i < size; ++i) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; ++bit) {
            crc = static_cast<std::uint16_t>((crc & 1) != 0 ? (crc >> 1) ^ 0x8408 : crc >> 1);
        }
    }
    return crc;
}

std::vector<std::uint8_t> encode(const Frame& frame, std::size_t payload_bytes) {
    const auto extra = crcExtra(frame.id);
    if (!extra || payload_bytes > Frame::kMaxPayload) {
        throw std::invalid_argument("MAVLink: unknown message " + std::to_string(frame.id) +
                                    " of " + std::to_string(payload_bytes) + " bytes");
    }
    // MAVLink 2 keeps at least one byte.
    while (payload_bytes > 1 && frame.payload[payload_bytes - 1] == 0) --payload_bytes;
    const std::array<std::uint8_t, 10> header{kStart,
                                              static_cast<std::uint8_t>(payload_bytes),
                                              0,
                                              0,
                                              frame.sequence,
                                              frame.system,
                                              frame.component,
                                              static_cast<std::uint8_t>(frame.id),
                                              static_cast<std::uint8_t>(frame.id >> 8),
                                              static_cast<std::uint8_t>(frame.id >> 16)};
    std::vector<std::uint8_t> bytes(header.size() + payload_bytes);
    std::copy_n(frame.payload.begin(), payload_bytes,
                std::copy(header.begin(), header.end(), bytes.begin()));
    const std::uint16_t crc = checksum(&*extra, 1, checksum(&bytes[1], bytes.size() - 1));
    bytes.push_back(static_cast<std::uint8_t>(crc));
    bytes.push_back(static_cast<std::uint8_t>(crc >> 8));
    return bytes;
}

}  // namespace hagen::mavlink
