#pragma once
#include <hagen/sensors/LidarDriver.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "sensors/RecentPackets.h"

namespace hagen::sensors {

/// Tracks the order of packets by sequence number and sensor time: counts duplicates, losses and
/// late packets.
class PacketSequence {
 public:
    enum class Step { Next, Late, Duplicate, TooLate, Interruption };

    /// `drops_late`: whether packets more than 16 packets late are TooLate (unless four in a row
    /// show that the clock was set back) instead of Late.
    explicit PacketSequence(bool drops_late) : drops_late_(drops_late) {}

    Step add(std::uint16_t number, std::uint64_t time_ns, double arrival_s, PacketCounts& counts);
    /// Sensor time of the latest packet.
    std::uint64_t last_ns() const { return last_ns_; }

 private:
    bool wentBack(std::uint64_t time_ns);
    Step stepTo(std::uint16_t number, std::uint64_t time_ns, PacketCounts& counts);

    bool drops_late_;
    bool has_last_ = false;
    std::uint64_t last_ns_ = 0;
    std::uint16_t last_number_ = 0;
    std::uint64_t too_late_ns_ = 0;  ///< time of the latest TooLate packet
    std::size_t too_late_in_a_row_ = 0;
    RecentPackets recent_;
};

/// Such as "293 packets in 5 scans, 2 packets lost".
std::string describe(const PacketCounts& counts, const char* scan);

}  // namespace hagen::sensors
