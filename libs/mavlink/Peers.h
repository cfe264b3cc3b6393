#pragma once
#include <hagen/mavlink/Peer.h>

#include <chrono>
#include <string>
#include <system_error>

namespace hagen::mavlink {

std::unique_ptr<Peer> openUdp(const PeerAddress& address);
std::unique_ptr<Peer> openSerial(const PeerAddress& address);
/// Whether a serial line can have this speed.
bool isBaud(int baud);

using Clock = std::chrono::steady_clock;

inline std::string errorText(int error) { return std::system_category().message(error); }

}  // namespace hagen::mavlink
