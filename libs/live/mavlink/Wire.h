#pragma once
#include <cstddef>
#include <cstdint>

// The layout of a MAVLink 2 frame: start, payload's length, two bytes of flags, sequence, system,
// component, three bytes of the message's number, payload, checksum, perhaps a signature.
namespace hagen::mavlink {

constexpr std::uint8_t kStart = 0xfd;
constexpr std::uint8_t kSigned = 0x01;  // of the flags that a receiver must know
constexpr std::size_t kHeaderBytes = 10, kChecksumBytes = 2, kSignatureBytes = 13;

}  // namespace hagen::mavlink
