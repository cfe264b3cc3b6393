#include "live/SensorAddress.h"

#include <algorithm>

namespace hagen::live {

bool SensorAddress::take(sensors::IpAddress ip, double arrival_s) {
    const bool is_own = choose(ip, !is_fixed_ && arrival_s - heard_s_ >= kSilence_s);
    if (is_own) heard_s_ = arrival_s;
    return is_own;
}

bool SensorAddress::choose(sensors::IpAddress ip, bool is_silent) {
    if (own_.empty()) own_.push_back(ip);
    if (ip == own_[current_]) return true;
    if (std::find(others_.begin(), others_.end(), ip) != others_.end()) return false;
    const auto own = std::find(own_.begin(), own_.end(), ip);
    if (own == own_.end()) {
        if (own_.size() + others_.size() >= kMaxAddresses) return false;
        (is_silent ? own_ : others_).push_back(ip);
        if (is_silent) current_ = own_.size() - 1;
        return is_silent;
    }
    const auto at = static_cast<std::size_t>(own - own_.begin());
    if (is_silent) {
        current_ = at;
        return true;
    }
    // Both addresses send, so there are two sensors; keeps the first.
    const std::size_t later = std::max(at, current_);
    current_ = std::min(at, current_);
    others_.push_back(own_[later]);
    own_.erase(own_.begin() + static_cast<std::ptrdiff_t>(later));
    return own_[current_] == ip;
}

}  // namespace hagen::live
