#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <type_traits>
#include <vector>

namespace hagen::mavlink {

/// The checksum of MAVLink: CRC-16/MCRF4XX, which is X.25 without its final inversion. `crc` is the
/// checksum of the preceding bytes.
std::uint16_t checksum(const std::uint8_t* bytes, std::size_t size, std::uint16_t crc = 0xffff);

/// The byte that a message definition adds to the checksum as a version check of its fields.
/// nullopt for messages that are not in the dialects common and ardupilotmega.
std::optional<std::uint8_t> crcExtra(std::uint32_t id);

/// A MAVLink message.
struct Frame {
    static constexpr std::size_t kMaxPayload = 255;
    /// Size of header, payload, checksum and signature.
    static constexpr std::size_t kMaxLength = 10 + kMaxPayload + 2 + 13;

    int version = 2;             ///< of MAVLink: 1 or 2
    std::uint8_t sequence = 0;   ///< message counter of the component, modulo 256
    std::uint8_t system = 0;     ///< ID of the sending vehicle
    std::uint8_t component = 0;  ///< ID of the sending component
    std::uint32_t id = 0;        ///< message ID, 24 bits
    /// Padded with zeros, because senders omit trailing zeros.
    std::array<std::uint8_t, kMaxPayload> payload{};
    bool is_signed = false;  ///< has a signature, which is not checked
};

/// The bytes of an unsigned MAVLink 2 frame on the wire, without trailing zeros in `payload_bytes`.
/// Throws std::invalid_argument if crcExtra() has no value for the message.
std::vector<std::uint8_t> encode(const Frame& frame, std::size_t payload_bytes);

/// Encodes the fields of a message (Messages.h) in a frame.
template <class Message>
Frame frameOf(const Message& message) {
    static_assert(std::is_trivially_copyable_v<Message> && sizeof message == Message::kBytes);
    Frame frame;
    frame.id = Message::kId;
    std::memcpy(frame.payload.data(), &message, sizeof message);
    return frame;
}

/// Decodes the fields of a message from a frame; nullopt for other messages. Extension fields that
/// an older sender omits are 0.
template <class Message>
std::optional<Message> messageOf(const Frame& frame) {
    if (frame.id != Message::kId) return std::nullopt;
    Message message;
    std::memcpy(&message, frame.payload.data(), sizeof message);
    return message;
}

}  // namespace hagen::mavlink
