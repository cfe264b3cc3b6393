#pragma once
#include "live/mavlink/Frame.h"

#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace hagen::live {

/// The senders of received messages, to explain a missing attitude.
class Senders {
 public:
    void add(const mavlink::Frame& frame);
    /// What each sender sends, and how to receive its attitude as that of vehicle `system`. Empty
    /// without senders.
    std::string text(std::uint8_t system) const;

 private:
    struct Sent {
        int version = 2;  ///< of MAVLink, of the latest message
        bool has_attitude = false, has_heartbeat = false;
    };
    std::map<std::pair<std::uint8_t, std::uint8_t>, Sent> senders_;  ///< by system and component
};

}  // namespace hagen::live
