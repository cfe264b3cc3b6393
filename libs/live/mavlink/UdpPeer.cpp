#include <hagen/sensors/Datagram.h>

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
constexpr int kMaxIgnored = 1000;  // datagrams at once; a flood must not delay sending

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
        // 0.0.0.0 means this machine, which replies from 127.0.0.1.
        if (to_ip.s_addr == INADDR_ANY) to_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        // Reports refused messages. Connecting would, too, but would hide other senders.
        const int yes = 1;
        setsockopt(socket_, IPPROTO_IP, IP_RECVERR, &yes, sizeof yes);
    }
    ~UdpPeer() override { close(socket_); }
    UdpPeer(const UdpPeer&) = delete;
    UdpPeer& operator=(const UdpPeer&) = delete;

    bool send(const std::vector<std::uint8_t>& bytes) override {
        // An error may belong to an earlier message, so this message is sent again.
        return sendOnce(bytes) || sendOnce(bytes);
    }

    std::size_t receive(std::uint8_t* buffer, std::size_t size, double longest_s) override {
        pollfd waits{socket_, POLLIN, 0};
        if (poll(&waits, 1, waitMs(longest_s)) <= 0) return 0;
        for (int n = 0; n < kMaxIgnored; ++n) {
            sockaddr_in from{};
            socklen_t from_size = sizeof from;
            const ssize_t got = recvfrom(socket_, buffer, size, MSG_DONTWAIT,
                                         reinterpret_cast<sockaddr*>(&from), &from_size);
            if (got < 0) {
                note(errno);
                // poll() does not wait while the queue of errors has entries.
                while (recv(socket_, nullptr, 0, MSG_ERRQUEUE | MSG_DONTWAIT) >= 0) {
                }
                return 0;
            }
            if (from.sin_addr.s_addr == to_.sin_addr.s_addr && from.sin_port == to_.sin_port) {
                error_ = 0;
                return static_cast<std::size_t>(got);
            }
            if (ignored_.datagrams++ > 0) continue;
            ignored_.sender = sensors::ipText(ntohl(from.sin_addr.s_addr)) + ":" +
                              std::to_string(ntohs(from.sin_port));
        }
        return 0;
    }

    Ignored ignored() const override { return ignored_; }
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
    bool sendOnce(const std::vector<std::uint8_t>& bytes) {
        const bool is_sent = sendto(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL,
                                    reinterpret_cast<const sockaddr*>(&to_), sizeof to_) >= 0;
        if (!is_sent) note(errno);
        return is_sent;
    }
    void note(int error) {
        if (error == EAGAIN || error == EINTR) return;
        error_ = error;
        error_time_ = Clock::now();
    }

    std::string name_;
    sockaddr_in to_{};
    int socket_ = -1, error_ = 0;
    Clock::time_point error_time_;
    Ignored ignored_;
};

}  // namespace

std::unique_ptr<Peer> openUdp(const PeerAddress& address) {
    return std::make_unique<UdpPeer>(address);
}

}  // namespace hagen::mavlink
