#include "live/mavlink/Peer.h"
#include "base/NumberText.h"

#include <stdexcept>

#include "live/mavlink/Peers.h"

namespace hagen::mavlink {
namespace {

constexpr int kMinBaud = 115200;

[[noreturn]] void fail(const std::string& text, const std::string& what) {
    throw std::runtime_error("'" + text + "': " + what);
}

std::vector<std::string> partsOf(const std::string& text) {
    std::vector<std::string> parts;
    std::size_t at = 0;
    for (;;) {
        const std::size_t end = text.find(':', at);
        parts.push_back(text.substr(at, end - at));
        if (end == std::string::npos) return parts;
        at = end + 1;
    }
}

std::uint16_t portOf(const std::string& text, const std::string& part) {
    const auto port = base::numberFrom<std::uint16_t>(part).value_or(0);
    if (port == 0) fail(text, "a port must be 1 to 65535");
    return port;
}

}  // namespace

PeerAddress parsePeer(const std::string& text) {
    const std::vector<std::string> parts = partsOf(text);
    PeerAddress address;
    if (parts[0] == "udp" && (parts.size() == 3 || parts.size() == 4) && !parts[1].empty()) {
        address.host = parts[1];
        address.port = portOf(text, parts[2]);
        if (parts.size() == 4) address.local_port = portOf(text, parts[3]);
        return address;
    }
    const std::size_t colon = text.rfind(':');
    if (parts[0] == "serial" && parts.size() >= 3 && colon > 7) {
        address.kind = PeerAddress::Kind::Serial;
        address.device = text.substr(7, colon - 7);
        address.baud = base::numberFrom<int>(parts.back()).value_or(0);
        if (!isBaud(address.baud)) fail(text, "unsupported baud rate");
        if (address.baud < kMinBaud) {
            fail(text, "messages need 6 kB/s, which requires at least 115200 baud");
        }
        return address;
    }
    fail(text, "is neither udp:HOST:PORT nor serial:DEVICE:BAUD");
}

std::unique_ptr<Peer> Peer::open(const PeerAddress& address) {
    return address.kind == PeerAddress::Kind::Udp ? openUdp(address) : openSerial(address);
}

}  // namespace hagen::mavlink
