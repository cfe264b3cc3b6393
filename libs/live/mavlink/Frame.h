#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <type_traits>
#include <vector>

namespace hagen::mavlink {

/// The checksum of MAVLink: CRC-16/MCRF4XX, which is X.25 without its final inversion. `crc` is
/// that of the bytes before.
std::uint16_t checksum(const std::uint8_t* bytes, std::size_t size, std::uint16_t crc = 0xffff);

/// The byte that the definition of a message adds to its checksum, so that sender and receiver
/// agree about its fields. None: the message is in none of the dialects common and ardupilotmega.
std::optional<std::uint8_t> crcExtra(std::uint32_t id);

/// A MAVLink 2 message of any kind.
struct Frame {
    static constexpr std::size_t kMaxPayload = 255;
    /// Header, payload, checksum and signature.
    static constexpr std::size_t kMaxLength = 10 + kMaxPayload + 2 + 13;

    std::uint8_t sequence = 0;   ///< counts the messages of a component, modulo 256
    std::uint8_t system = 0;     ///< the vehicle that sent it
    std::uint8_t component = 0;  ///< its part that sent it
    std::uint32_t id = 0;        ///< kind of message, 24 bits
    /// The payload; zeros behind its end, which the sender left out.
    std::array<std::uint8_t, kMaxPayload> payload{};
    bool is_signed = false;  ///< it has a signature, which is not checked
};

/// The bytes of a frame on the wire: zeros at the end of the `payload_bytes` are left out.
/// Unsigned. Throws std::invalid_argument if crcExtra() does not know the message.
std::vector<std::uint8_t> encode(const Frame& frame, std::size_t payload_bytes);

/// Puts the fields of a message (Messages.h) into a frame.
template <class Message>
Frame frameOf(const Message& message) {
    static_assert(std::is_trivially_copyable_v<Message>);
    Frame frame;
    frame.id = Message::kId;
    // Fields are little-endian and never padded, as on all processors that Hagen runs on.
    Message::eachField(message, [&](std::size_t offset, const auto& field) {
        std::memcpy(frame.payload.data() + offset, &field, sizeof field);
    });
    return frame;
}

/// Reads the fields of a message from a frame; none if it is of another kind. Extensions that an
/// older sender does not know are 0.
template <class Message>
std::optional<Message> messageOf(const Frame& frame) {
    if (frame.id != Message::kId) return std::nullopt;
    Message message;
    Message::eachField(message, [&](std::size_t offset, auto& field) {
        std::memcpy(&field, frame.payload.data() + offset, sizeof field);
    });
    return message;
}

}  // namespace hagen::mavlink
