#pragma once
#include <hagen/live/PacketQueue.h>
#include <hagen/sensors/CaptureFile.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hagen::live {

struct Address {
    std::uint32_t ip = 0;  ///< 0 for all local interfaces
    std::uint16_t port = 0;

    bool isMulticast() const { return (ip >> 28) == 0xe; }
};
/// Parses "192.168.1.201"; nullopt for other texts.
std::optional<std::uint32_t> ipFrom(const std::string& text);
/// Parses "192.168.1.77:2368" or "0.0.0.0:2368". Throws std::runtime_error describing the error.
Address parseAddress(const std::string& text);

class PacketSource {
 public:
    enum class Next { Packet, Nothing, End };

    virtual ~PacketSource() = default;
    /// Waits up to 0.1 s for the next packet. Throws std::runtime_error naming the source if it
    /// cannot be read.
    virtual Next next(Packet& packet) = 0;
    /// Whether packets are lost if they are not read in time.
    virtual bool isLive() const = 0;
};

/// Receives datagrams sent to a local address or a multicast group. Arrival times are kernel time
/// stamps and never decrease.
class UdpSource : public PacketSource {
 public:
    /// Throws std::runtime_error naming the address if the socket cannot be bound.
    explicit UdpSource(const Address& address);
    ~UdpSource() override;
    UdpSource(const UdpSource&) = delete;
    UdpSource& operator=(const UdpSource&) = delete;

    Next next(Packet& packet) override;
    bool isLive() const override { return true; }
    /// Size of the kernel's receive buffer.
    int bufferBytes() const { return buffer_bytes_; }

 private:
    int socket_ = -1, buffer_bytes_ = 0;
    std::uint16_t port_ = 0;
    std::string name_;
    std::vector<std::uint8_t> buffer_;
    double latest_arrival_s_ = steadyNow_s();
};

/// Replays the datagrams of a capture at `speed` times the recorded rate.
class ReplaySource : public PacketSource {
 public:
    /// Throws BrokenCapture naming the file.
    ReplaySource(const std::filesystem::path& file, double speed);

    Next next(Packet& packet) override;
    bool isLive() const override { return false; }

 private:
    struct NoneYet {};
    bool readWaiting();

    sensors::CaptureFile capture_;
    double speed_;
    sensors::Datagram waiting_;
    bool has_waiting_ = false;
    double search_start_s_ = 0;
    std::optional<std::int64_t> latest_ns_;
    double start_s_ = 0, played_s_ = 0;  ///< capture time, without long pauses
};

}  // namespace hagen::live
