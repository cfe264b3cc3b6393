#pragma once
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <list>
#include <vector>

#include "sensors/captures/IpFrames.h"

namespace hagen::sensors {

/// Puts datagrams together from their IP fragments, in whatever order these come. Few are open at a
/// time; the oldest gives way to another.
class Fragments {
 public:
    /// Takes a fragment. Returns the content of its datagram once that is complete, valid until the
    /// next call; otherwise none.
    Bytes add(const IpPacket& fragment);

    /// Fragments of datagrams that were never completed. At the end, those still open are, too.
    std::size_t lost() const { return lost_; }
    void giveUpAll();

 private:
    static constexpr std::size_t kMaxOpen = 16;
    static constexpr std::size_t kUnit = 8;  ///< of offsets, bytes
    struct Open {
        std::uint32_t from_ip, to_ip;
        std::uint16_t id;
        std::vector<std::uint8_t> bytes;
        std::bitset<65536 / kUnit> has_unit;
        std::size_t size = 0;       ///< of the datagram; 0: its last fragment is missing
        std::size_t fragments = 0;  ///< so far
    };
    std::list<Open>::iterator find(const IpPacket& fragment);
    static bool isComplete(const Open& open);

    std::list<Open> open_;  ///< oldest first
    std::vector<std::uint8_t> complete_;
    std::size_t lost_ = 0;
};

}  // namespace hagen::sensors
