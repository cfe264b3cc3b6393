#include <hagen/live/PacketSource.h>
#include "base/NumberText.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <ctime>
#include <stdexcept>
#include <system_error>
#include <thread>

namespace hagen::live {
namespace {

constexpr int kBufferBytes = 8 << 20;     // about one second of HDL-64E data
constexpr std::size_t kMaxBytes = 65536;  // maximum size of a datagram
constexpr double kMaxWait_s = 0.1;
/// The maximum replayed pause of a capture; longer pauses (clock changes, sensor off) are skipped.
constexpr double kMaxPause_s = 2;

[[noreturn]] void fail(const std::string& what) {
    throw std::runtime_error(what + ": " + std::system_category().message(errno));
}

std::int64_t nanoseconds(const timespec& time) {
    return std::int64_t{time.tv_sec} * 1000000000 + time.tv_nsec;
}

}  // namespace

std::optional<std::uint32_t> ipFrom(const std::string& text) {
    in_addr ip{};
    if (inet_pton(AF_INET, text.c_str(), &ip) != 1) return std::nullopt;
    return ntohl(ip.s_addr);
}

Address parseAddress(const std::string& text) {
    const std::size_t colon = text.rfind(':');
    const auto ip = ipFrom(text.substr(0, colon));
    if (colon == std::string::npos || !ip) {
        throw std::runtime_error("'" + text +
                                 "' is not an IPv4 address with a port, such as 0.0.0.0:2368");
    }
    const auto port = base::numberFrom<std::uint16_t>(text.substr(colon + 1)).value_or(0);
    if (port == 0) throw std::runtime_error("'" + text + "': the port must be 1 to 65535");
    return {*ip, port};
}

UdpSource::UdpSource(const Address& address)
    : port_(address.port),
      name_(sensors::ipText(address.ip) + ":" + std::to_string(address.port)),
      buffer_(kMaxBytes) {
    socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (socket_ < 0) fail(name_);
    try {
        const int yes = 1;
        // SO_RCVBUF is limited by net.core.rmem_max, but SO_RCVBUFFORCE needs CAP_NET_ADMIN.
        if (setsockopt(socket_, SOL_SOCKET, SO_RCVBUFFORCE, &kBufferBytes, sizeof kBufferBytes) !=
            0)
            setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &kBufferBytes, sizeof kBufferBytes);
        socklen_t size = sizeof buffer_bytes_;
        getsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &buffer_bytes_, &size);
        setsockopt(socket_, SOL_SOCKET, SO_TIMESTAMPNS, &yes, sizeof yes);
        setsockopt(socket_, IPPROTO_IP, IP_PKTINFO, &yes, sizeof yes);
        // Several programs may receive from a multicast group, but sharing a unicast address would
        // divert packets from the first program.
        if (address.isMulticast()) {
            setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
        }
        sockaddr_in at{};
        at.sin_family = AF_INET;
        at.sin_port = htons(address.port);
        at.sin_addr.s_addr = htonl(address.ip);
        if (bind(socket_, reinterpret_cast<const sockaddr*>(&at), sizeof at) != 0) {
            fail(name_ + ": cannot listen");
        }
        if (address.isMulticast()) {
            ip_mreq group{};
            group.imr_multiaddr.s_addr = htonl(address.ip);
            if (setsockopt(socket_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &group, sizeof group) != 0) {
                fail(name_ + ": cannot join the group");
            }
        }
    } catch (...) {
        close(socket_);
        throw;
    }
}

UdpSource::~UdpSource() { close(socket_); }

PacketSource::Next UdpSource::next(Packet& packet) {
    pollfd waits{socket_, POLLIN, 0};
    const int ready = poll(&waits, 1, static_cast<int>(1000 * kMaxWait_s));
    if (ready < 0 && errno != EINTR) fail(name_);
    if (ready <= 0) return Next::Nothing;
    sockaddr_in from{};
    iovec part{buffer_.data(), buffer_.size()};
    alignas(cmsghdr) std::array<char, 128> control{};
    msghdr message{};
    message.msg_name = &from;
    message.msg_namelen = sizeof from;
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    const ssize_t size = recvmsg(socket_, &message, MSG_DONTWAIT);
    if (size < 0) {
        // ECONNREFUSED reports an undelivered datagram, but this socket never sends.
        if (errno == EINTR || errno == EAGAIN || errno == ECONNREFUSED) return Next::Nothing;
        fail(name_);
    }
    packet.bytes.assign(buffer_.begin(), buffer_.begin() + size);
    packet.from_ip = ntohl(from.sin_addr.s_addr);
    packet.from_port = ntohs(from.sin_port);
    packet.to_port = port_;
    packet.arrival_s = steadyNow_s();  // read first, so that later calls do not increase the age
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    packet.time_ns = nanoseconds(now);
    for (cmsghdr* part_of = CMSG_FIRSTHDR(&message); part_of != nullptr;
         part_of = CMSG_NXTHDR(&message, part_of)) {
        if (part_of->cmsg_level == IPPROTO_IP && part_of->cmsg_type == IP_PKTINFO) {
            in_pktinfo info{};
            std::memcpy(&info, CMSG_DATA(part_of), sizeof info);
            packet.to_ip = ntohl(info.ipi_addr.s_addr);
        }
        if (part_of->cmsg_level != SOL_SOCKET || part_of->cmsg_type != SCM_TIMESTAMPNS) continue;
        timespec stamp{};
        std::memcpy(&stamp, CMSG_DATA(part_of), sizeof stamp);
        const std::int64_t waited_ns = packet.time_ns - nanoseconds(stamp);
        packet.arrival_s -= 1e-9 * static_cast<double>(waited_ns);
        packet.time_ns -= waited_ns;
        // If the system clock was set back meanwhile, the arrival time is unknown.
        if (waited_ns < 0) packet.arrival_s = latest_arrival_s_;
    }
    packet.arrival_s = latest_arrival_s_ = std::max(latest_arrival_s_, packet.arrival_s);
    return Next::Packet;
}

ReplaySource::ReplaySource(const std::filesystem::path& file, double speed)
    : capture_(file), speed_(speed) {
    capture_.checkWhileReading([this] {
        if (steadyNow_s() - search_start_s_ > kMaxWait_s) throw NoneYet();
    });
}

/// Reads the next datagram; false at the end. Throws NoneYet after many frames without a datagram.
bool ReplaySource::readWaiting() {
    search_start_s_ = steadyNow_s();
    return capture_.next(waiting_);
}

PacketSource::Next ReplaySource::next(Packet& packet) {
    if (!has_waiting_) {
        try {
            if (!readWaiting()) return Next::End;
        } catch (const NoneYet&) {
            return Next::Nothing;
        }
        has_waiting_ = true;
        if (!latest_ns_) start_s_ = steadyNow_s();
        const double pause_s =
            latest_ns_
                ? 1e-9 * (static_cast<double>(waiting_.time_ns) - static_cast<double>(*latest_ns_))
                : 0;
        if (std::abs(pause_s) <= kMaxPause_s) played_s_ += pause_s;
        latest_ns_ = waiting_.time_ns;
    }
    const double wait_s = start_s_ + played_s_ / speed_ - steadyNow_s();
    if (wait_s > 0) {
        std::this_thread::sleep_for(std::chrono::duration<double>(std::min(wait_s, kMaxWait_s)));
        if (wait_s > kMaxWait_s) return Next::Nothing;
    }
    has_waiting_ = false;
    packet.bytes.assign(waiting_.bytes, waiting_.bytes + waiting_.size);
    packet.time_ns = waiting_.time_ns;
    packet.from_ip = waiting_.from_ip;
    packet.to_ip = waiting_.to_ip;
    packet.from_port = waiting_.from_port;
    packet.to_port = waiting_.to_port;
    packet.arrival_s = steadyNow_s();
    return Next::Packet;
}

}  // namespace hagen::live
