#pragma once
#include <hagen/sensors/Datagram.h>

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

namespace hagen::live {

/// A datagram that came.
struct Packet {
    std::vector<std::uint8_t> bytes;
    std::int64_t time_ns = 0;  ///< since 1970: when it came, of a capture when it was recorded
    double arrival_s = 0;      ///< when it came, by steadyNow_s()
    std::uint32_t from_ip = 0, to_ip = 0;  ///< IPv4
    std::uint16_t from_port = 0, to_port = 0;

    /// Valid as long as the packet.
    sensors::Datagram datagram() const {
        return {time_ns, from_ip, to_ip, from_port, to_port, bytes.data(), bytes.size()};
    }
};

/// Seconds of a clock that does not jump.
double steadyNow_s();

/// Packets from the thread that receives them to the one that labels them. Bounded, and its memory
/// is reused: it has as much as the packets that waited at a time.
class PacketQueue {
 public:
    explicit PacketQueue(std::size_t most);

    /// Adds a packet; its memory is exchanged for that of an older one. If the queue is full,
    /// false: the packet is lost.
    bool push(Packet& packet);
    /// The same, but waits for a place; false if the queue was closed.
    bool pushOrWait(Packet& packet);
    /// No packets follow.
    void close();

    enum class Popped { Packet, Nothing, Closed };
    /// Takes the oldest packet; waits at most this long for one.
    Popped pop(Packet& packet, std::chrono::microseconds longest);
    /// How many packets wait.
    std::size_t size() const;

 private:
    void put(Packet& packet);

    mutable std::mutex mutex_;
    std::condition_variable has_packet_, has_place_;
    std::vector<Packet> ring_;
    std::vector<std::vector<std::uint8_t>> spare_;  ///< memory for the next packets, last first
    std::size_t first_ = 0, size_ = 0;
    bool is_closed_ = false;
};

}  // namespace hagen::live
