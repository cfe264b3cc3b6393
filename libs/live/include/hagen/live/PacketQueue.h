#pragma once
#include <hagen/sensors/Datagram.h>

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

namespace hagen::live {

/// A received datagram.
struct Packet {
    std::vector<std::uint8_t> bytes;
    std::int64_t time_ns = 0;  ///< arrival, or recording time in a capture, since 1970
    double arrival_s = 0;      ///< arrival on the clock of steadyNow_s()
    sensors::IpAddress from_ip, to_ip;
    std::uint16_t from_port = 0, to_port = 0;

    /// The result is valid as long as the packet.
    sensors::Datagram datagram() const {
        return {time_ns, from_ip, to_ip, from_port, to_port, bytes.data(), bytes.size()};
    }
};

/// Seconds of a monotonic clock.
double steadyNow_s();

/// Passes packets from the receiving to the labelling thread. The queue is bounded and reuses
/// buffers, so its memory grows only with the maximum number of waiting packets.
class PacketQueue {
 public:
    explicit PacketQueue(std::size_t max);

    /// Adds a packet by swapping its buffer with a used one. Returns false if the queue is full and
    /// the packet was dropped.
    bool push(Packet& packet);
    /// Waits while the queue is full; returns false if it was closed.
    bool pushOrWait(Packet& packet);
    /// Marks the end of the stream.
    void close();

    enum class Popped { Packet, Nothing, Closed };
    /// Takes the oldest packet; waits up to `longest` if the queue is empty.
    Popped pop(Packet& packet, std::chrono::microseconds longest);
    std::size_t size() const;

 private:
    void put(Packet& packet);

    mutable std::mutex mutex_;
    std::condition_variable has_packet_, has_place_;
    std::vector<Packet> ring_;
    std::vector<std::vector<std::uint8_t>> spare_;  ///< free buffers, used from the back
    std::size_t first_ = 0, size_ = 0;
    bool is_closed_ = false;
};

}  // namespace hagen::live
