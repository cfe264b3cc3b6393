#pragma once
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <list>
#include <vector>

#include "sensors/captures/IpFrames.h"

namespace hagen::sensors {

/// Reassembles datagrams from IP fragments in arbitrary order. Keeps a limited number of incomplete
/// datagrams and evicts the oldest.
class Fragments {
 public:
    /// Adds a fragment. If it completes a datagram, returns the content, which is valid until the
    /// next call; otherwise returns nothing.
    Bytes add(const IpPacket& fragment);

    /// Number of invalid or evicted fragments. giveUpAll() adds those of incomplete datagrams.
    std::size_t lost() const { return lost_; }
    void giveUpAll();

 private:
    static constexpr std::size_t kMaxOpen = 16;
    static constexpr std::size_t kUnit = 8;  ///< unit of fragment offsets, bytes
    struct Open {
        IpAddress from_ip, to_ip;
        std::uint32_t id;
        std::vector<std::uint8_t> bytes;
        std::bitset<65536 / kUnit> has_unit;
        std::size_t size = 0;  ///< size of the datagram; 0 until its last fragment arrives
        std::size_t fragments = 0;
    };
    std::list<Open>::iterator find(const IpPacket& fragment);
    static bool isComplete(const Open& open);

    std::list<Open> open_;  ///< oldest first
    std::vector<std::uint8_t> complete_;
    std::size_t lost_ = 0;
};

}  // namespace hagen::sensors
