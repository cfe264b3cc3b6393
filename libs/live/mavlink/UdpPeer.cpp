#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>

#include "live/mavlink/Peers.h"

namespace hagen::mavlink {
namespace {

// The send after a refused message reports the refusal. After this time without errors, the
// connection is restored.
constexpr std::chrono::milliseconds kRefusedFor{1000};
// A connected socket keeps its local address. If no replies arrive, another interface may be right,
// because it was down before or its address changed. Reconnects after this time.
constexpr std::chrono::milliseconds kSilent{2000};

class UdpPeer : public Peer {
 public:
    explicit UdpPeer(const PeerAddress& address)
        : name_(address.host + ":" + std::to_string(address.port)) {
        const in_addr to_ip = resolve(address.host);
        socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
        if (socket_ < 0) fail("cannot create a socket", errno);
        if (address.local_port != 0) {
            sockaddr_in at{};
            at.sin_family = AF_INET;
            at.sin_port = htons(address.local_port);
            if (bind(socket_, reinterpret_cast<const sockaddr*>(&at), sizeof at) != 0) {
                const int error = errno;
                close(socket_);
                fail("cannot listen on port " + std::to_string(address.local_port), error);
            }
        }
        to_.sin_family = AF_INET;
        to_.sin_port = htons(address.port);
        to_.sin_addr = to_ip;
        tryToConnect();
    }
    ~UdpPeer() override { close(socket_); }
    UdpPeer(const UdpPeer&) = delete;
    UdpPeer& operator=(const UdpPeer&) = delete;

    bool send(const std::vector<std::uint8_t>& bytes) override {
        if (is_connected_ && Clock::now() - heard_or_connected_ > kSilent) disconnect();
        if (!is_connected_) tryToConnect();
        if (!is_connected_) return false;
        if (::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) >= 0) return true;
        note(errno);
        // The error may belong to an earlier message, so this message is sent again.
        return errno == ECONNREFUSED &&
               ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) >= 0;
    }

    std::size_t receive(std::uint8_t* buffer, std::size_t size, double longest_s) override {
        pollfd waits{socket_, POLLIN, 0};
        if (poll(&waits, 1, waitMs(longest_s)) <= 0) return 0;
        sockaddr_in from{};
        socklen_t from_size = sizeof from;
        const ssize_t got = recvfrom(socket_, buffer, size, MSG_DONTWAIT,
                                     reinterpret_cast<sockaddr*>(&from), &from_size);
        if (got > 0) {
            // Datagrams that were queued before the socket was connected may come from other
            // senders.
            if (from.sin_addr.s_addr != peer_.sin_addr.s_addr || from.sin_port != peer_.sin_port) {
                return 0;
            }
            error_ = 0;
            heard_or_connected_ = Clock::now();
            return static_cast<std::size_t>(got);
        }
        if (got < 0) note(errno);
        return 0;
    }

    bool hasDatagrams() const override { return true; }
    std::string name() const override { return name_; }

    std::string trouble() const override {
        if (error_ == 0 || Clock::now() - error_time_ > kRefusedFor) return "";
        if (error_ == ECONNREFUSED) return name_ + ": connection refused";
        return name_ + ": cannot be reached: " + errorText(error_);
    }

 private:
    [[noreturn]] void fail(const std::string& what, int error) const {
        throw std::runtime_error(name_ + ": " + what + ": " + errorText(error));
    }
    static in_addr resolve(const std::string& host) {
        addrinfo wanted{};
        wanted.ai_family = AF_INET;
        wanted.ai_socktype = SOCK_DGRAM;
        addrinfo* found = nullptr;
        const int error = getaddrinfo(host.c_str(), nullptr, &wanted, &found);
        if (error != 0) throw std::runtime_error(host + ": no such host: " + gai_strerror(error));
        const in_addr ip = reinterpret_cast<const sockaddr_in*>(found->ai_addr)->sin_addr;
        freeaddrinfo(found);
        return ip;
    }
    /// Tries to connect, which fails while the network is down.
    void tryToConnect() {
        is_connected_ = connect(socket_, reinterpret_cast<const sockaddr*>(&to_), sizeof to_) == 0;
        if (!is_connected_) note(errno);
        socklen_t size = sizeof peer_;
        // May differ from `to_`, because 0.0.0.0 means this machine.
        if (getpeername(socket_, reinterpret_cast<sockaddr*>(&peer_), &size) != 0) peer_ = {};
        heard_or_connected_ = Clock::now();
    }
    /// Disconnects, but keeps the local port, which the peer replies to.
    void disconnect() {
        sockaddr_in own{}, none{};
        socklen_t size = sizeof own;
        getsockname(socket_, reinterpret_cast<sockaddr*>(&own), &size);
        none.sin_family = AF_UNSPEC;
        if (connect(socket_, reinterpret_cast<const sockaddr*>(&none), sizeof none) != 0) return;
        is_connected_ = false;
        own.sin_addr.s_addr = INADDR_ANY;
        // bind() fails harmlessly if the port is still bound.
        static_cast<void>(bind(socket_, reinterpret_cast<const sockaddr*>(&own), sizeof own));
    }
    void note(int error) {
        if (error == EAGAIN || error == EINTR) return;
        error_ = error;
        error_time_ = Clock::now();
    }

    std::string name_;
    sockaddr_in to_{}, peer_{};  ///< requested address, and last connected address
    int socket_ = -1, error_ = 0;
    bool is_connected_ = false;
    Clock::time_point error_time_, heard_or_connected_;
};

}  // namespace

std::unique_ptr<Peer> openUdp(const PeerAddress& address) {
    return std::make_unique<UdpPeer>(address);
}

}  // namespace hagen::mavlink
