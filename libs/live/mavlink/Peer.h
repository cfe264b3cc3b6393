#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace hagen::mavlink {

/// Where messages are sent to, and come from.
struct PeerAddress {
    enum class Kind { Udp, Serial };
    Kind kind = Kind::Udp;
    std::string host;              ///< IPv4 address or name
    std::uint16_t port = 0;        ///< of it
    std::uint16_t local_port = 0;  ///< ours; 0: any
    std::string device;            ///< of a serial line
    int baud = 0;
};

/// Reads "udp:192.168.1.10:14550", "udp:localhost:14580:14540" (with the port that we listen on) or
/// "serial:/dev/ttyAMA0:921600". Throws std::runtime_error saying what is wrong.
PeerAddress parsePeer(const std::string& text);

/// The other end of a UDP connection or a serial line, which may disappear and return. Sending
/// never waits: a delayed message would be stale.
class Peer {
 public:
    /// Throws std::runtime_error naming the host or device if it is not known or cannot be opened.
    static std::unique_ptr<Peer> open(const PeerAddress& address);
    virtual ~Peer() = default;

    /// Sends a whole message, or returns false.
    virtual bool send(const std::vector<std::uint8_t>& bytes) = 0;
    /// Waits at most this long for bytes (up to an hour; negative: not at all); returns their
    /// number.
    virtual std::size_t receive(std::uint8_t* buffer, std::size_t size, double longest_s) = 0;
    /// Whether receive() returns one datagram, with whole messages.
    virtual bool hasDatagrams() const = 0;
    /// Host and port, or device.
    virtual std::string name() const = 0;
    /// The current error with the name; "" without one.
    virtual std::string trouble() const = 0;
};

}  // namespace hagen::mavlink
