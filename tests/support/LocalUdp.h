#pragma once
// Local UDP sockets for tests of programs that send and receive.
#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace hagen::test {

/// Time of the steady clock in seconds, as used by hagen::live.
inline double steadyNow_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

inline sockaddr_in localAddress(std::uint16_t port) {
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_port = htons(port);
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return at;
}

/// A UDP socket bound to a local port.
class LocalUdp {
 public:
    struct Datagram {
        std::string bytes;
        sockaddr_in from;
    };

    /// `wait`: timeout of receive() (default: none). `port`: 0 selects a free port.
    explicit LocalUdp(std::chrono::milliseconds wait = std::chrono::milliseconds(0),
                      std::uint16_t port = 0)
        : socket_(socket(AF_INET, SOCK_DGRAM, 0)) {
        sockaddr_in at = localAddress(port);
        is_bound_ = bind(socket_, reinterpret_cast<const sockaddr*>(&at), sizeof at) == 0;
        socklen_t size = sizeof at;
        getsockname(socket_, reinterpret_cast<sockaddr*>(&at), &size);
        port_ = ntohs(at.sin_port);
        const timeval time{wait.count() / 1000, 1000 * (wait.count() % 1000)};
        setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &time, sizeof time);
    }
    ~LocalUdp() { close(socket_); }
    LocalUdp(const LocalUdp&) = delete;
    LocalUdp& operator=(const LocalUdp&) = delete;

    std::uint16_t port() const { return port_; }
    bool isBound() const { return is_bound_; }

    std::optional<Datagram> receive() const {
        std::array<char, 2048> buffer{};
        Datagram datagram{{}, {}};
        socklen_t size = sizeof datagram.from;
        const ssize_t got = recvfrom(socket_, buffer.data(), buffer.size(), 0,
                                     reinterpret_cast<sockaddr*>(&datagram.from), &size);
        if (got <= 0) return std::nullopt;
        datagram.bytes.assign(buffer.data(), static_cast<std::size_t>(got));
        return datagram;
    }
    template <class Bytes>
    void send(const Bytes& bytes, const sockaddr_in& to) const {
        sendto(socket_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to),
               sizeof to);
    }

 private:
    int socket_;
    bool is_bound_ = false;
    std::uint16_t port_ = 0;
};

/// A local port without a listener.
inline std::uint16_t freePort() { return LocalUdp().port(); }

}  // namespace hagen::test
