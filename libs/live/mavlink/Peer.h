#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace hagen::mavlink {

/// Address of the other end of a connection.
struct PeerAddress {
    enum class Kind { Udp, Serial };
    Kind kind = Kind::Udp;
    std::string host;              ///< IPv4 address or name
    std::uint16_t port = 0;        ///< remote port
    std::uint16_t local_port = 0;  ///< local port; 0 if arbitrary
    std::string device;            ///< serial device
    int baud = 0;
};

/// Parses "udp:192.168.1.10:14550", "udp:localhost:14580:14540" (with the local port) or
/// "serial:/dev/ttyAMA0:921600". Throws std::runtime_error describing the error.
PeerAddress parsePeer(const std::string& text);

/// A UDP or serial connection, which may be interrupted. Sending never blocks, because a delayed
/// message would be stale.
class Peer {
 public:
    /// Throws std::runtime_error naming the host or device if it is unknown or cannot be opened.
    static std::unique_ptr<Peer> open(const PeerAddress& address);
    virtual ~Peer() = default;

    /// Sends a complete message, or returns false.
    virtual bool send(const std::vector<std::uint8_t>& bytes) = 0;
    /// Waits up to `longest_s` for bytes (at most an hour; not at all if negative); returns their
    /// number.
    virtual std::size_t receive(std::uint8_t* buffer, std::size_t size, double longest_s) = 0;
    /// Whether each receive() returns one datagram of complete messages.
    virtual bool hasDatagrams() const = 0;
    /// Received datagrams from other addresses than the peer's.
    struct Ignored {
        std::size_t datagrams = 0;
        std::string sender;  ///< address and port of the first
    };
    virtual Ignored ignored() const { return {}; }
    /// Host and port, or device.
    virtual std::string name() const = 0;
    /// The current error with the peer's name; empty if none.
    virtual std::string trouble() const = 0;
};

}  // namespace hagen::mavlink
