#pragma once
#include <cstddef>
#include <cstdint>

// Layout of a MAVLink 2 frame: start, payload length, 2 flag bytes, sequence, system, component,
// 3-byte message ID, payload, checksum, optional signature.
namespace hagen::mavlink {

constexpr std::uint8_t kStart = 0xfd;
// MAVLink 1: start, payload length, sequence, system, component, message ID, payload, checksum.
constexpr std::uint8_t kStart1 = 0xfe;
constexpr std::size_t kHeaderBytes1 = 6;
constexpr std::uint8_t kSigned = 0x01;  // incompatibility flag of signed messages
constexpr std::size_t kHeaderBytes = 10, kChecksumBytes = 2, kSignatureBytes = 13;

}  // namespace hagen::mavlink
