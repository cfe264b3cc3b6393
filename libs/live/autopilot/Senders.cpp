#include "live/autopilot/Senders.h"
#include "live/autopilot/Messages.h"

namespace hagen::live {

void Senders::add(const mavlink::Frame& frame) {
    constexpr std::size_t kMaxSenders = 16;
    if (senders_.size() == kMaxSenders && senders_.count({frame.system, frame.component}) == 0)
        return;
    Sent& sent = senders_[{frame.system, frame.component}];
    sent.version = frame.version;
    sent.has_heartbeat = sent.has_heartbeat || frame.id == mavlink::Heartbeat::kId;
    sent.has_attitude = sent.has_attitude || frame.id == mavlink::Attitude::kId ||
                        frame.id == mavlink::AttitudeQuaternion::kId;
}

std::string Senders::text(std::uint8_t system) const {
    std::string text;
    for (const auto& [sender, sent] : senders_) {
        const bool is_autopilot = sender.second == mavlink::kComponentAutopilot;
        text += (text.empty() ? "system " : "; system ") + std::to_string(sender.first);
        if (!is_autopilot) text += ", component " + std::to_string(sender.second);
        text += ": MAVLink " + std::to_string(sent.version) +
                (sent.has_attitude ? ", ATTITUDE" : ", no ATTITUDE") +
                (sent.has_heartbeat ? ", HEARTBEAT" : ", no HEARTBEAT");
        if (!is_autopilot) continue;
        std::string advice;
        const auto advise = [&](const std::string& what) {
            advice += (advice.empty() ? "" : ", ") + what;
        };
        if (sender.first != system) advise("--mavlink-system " + std::to_string(sender.first));
        if (sent.version == 1) advise("SERIALn_PROTOCOL = 2 (PX4: MAV_PROTO_VER = 2)");
        if (!sent.has_attitude) advise("SRn_EXTRA1 = 50 (PX4: MAV_n_MODE = Onboard)");
        if (!advice.empty()) text += " [set " + advice + "]";
    }
    return text;
}

}  // namespace hagen::live
