#include "sensors/captures/Fragments.h"

#include <algorithm>

namespace hagen::sensors {

std::list<Fragments::Open>::iterator Fragments::find(const IpPacket& fragment) {
    const auto found = std::find_if(open_.begin(), open_.end(), [&](const Open& open) {
        return open.id == fragment.id && open.from_ip == fragment.from_ip &&
               open.to_ip == fragment.to_ip;
    });
    if (found != open_.end()) return found;
    if (open_.size() == kMaxOpen) {
        lost_ += open_.front().fragments;
        open_.pop_front();
    }
    Open& open = open_.emplace_back();
    open.from_ip = fragment.from_ip;
    open.to_ip = fragment.to_ip;
    open.id = fragment.id;
    return std::prev(open_.end());
}

bool Fragments::isComplete(const Open& open) {
    if (open.size == 0) return false;
    for (std::size_t unit = 0; unit * kUnit < open.size; ++unit) {
        if (!open.has_unit[unit]) return false;
    }
    return true;
}

Bytes Fragments::add(const IpPacket& fragment) {
    constexpr std::size_t kMaxBytes = 65535;
    const std::size_t end = fragment.offset + fragment.content.size;
    const bool is_whole_units = !fragment.has_more || fragment.content.size % kUnit == 0;
    if (end > kMaxBytes || fragment.content.size == 0 || !is_whole_units) {
        ++lost_;
        return {};
    }
    const auto at = find(fragment);
    Open& open = *at;
    ++open.fragments;
    if (open.bytes.size() < end) open.bytes.resize(end);
    std::copy_n(fragment.content.data, fragment.content.size, open.bytes.begin() + fragment.offset);
    for (std::size_t byte = fragment.offset; byte < end; byte += kUnit) {
        open.has_unit.set(byte / kUnit);
    }
    if (!fragment.has_more) open.size = end;
    if (!isComplete(open)) return {};
    complete_ = std::move(open.bytes);
    complete_.resize(open.size);
    open_.erase(at);
    return {complete_.data(), complete_.size()};
}

void Fragments::giveUpAll() {
    for (const Open& open : open_) lost_ += open.fragments;
    open_.clear();
}

}  // namespace hagen::sensors
