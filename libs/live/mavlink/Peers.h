#pragma once
#include "live/mavlink/Peer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <system_error>

namespace hagen::mavlink {

std::unique_ptr<Peer> openUdp(const PeerAddress& address);
std::unique_ptr<Peer> openSerial(const PeerAddress& address);
/// Whether serial lines support this baud rate.
bool isBaud(int baud);

using Clock = std::chrono::steady_clock;

/// The timeout for poll(); not negative, which would block forever.
inline int waitMs(double longest_s) {
    constexpr double kMaxDuration_s = 3600;
    if (!(longest_s > 0)) return 0;
    return static_cast<int>(std::ceil(1e3 * std::min(longest_s, kMaxDuration_s)));
}

inline std::string errorText(int error) { return std::system_category().message(error); }

}  // namespace hagen::mavlink
