#include "sensors/captures/Remarks.h"

#include <algorithm>

namespace hagen::sensors {

void addCount(std::size_t number, const std::string& one, const std::string& more,
              std::string& text) {
    if (number == 0) return;
    text += (text.empty() ? "" : ", ") + counted(number, one) + (more.empty() ? "" : " ") + more;
}

std::string joined(const std::string& first, const std::string& second) {
    return first + (first.empty() || second.empty() ? "" : ", ") + second;
}

void OtherDatagrams::add(const Datagram& datagram) {
    constexpr std::size_t kMaxKinds = 64;
    ++all_;
    const std::pair kind{datagram.to_port, datagram.size};
    if (kinds_.size() < kMaxKinds || kinds_.count(kind) > 0) ++kinds_[kind];
}

void OtherDatagrams::describe(std::string& text) const {
    if (all_ == 0) return;
    const auto max =
        std::max_element(kinds_.begin(), kinds_.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    addCount(all_, "other UDP datagram",
             "(most: " + std::to_string(max->second) + " of " + std::to_string(max->first.second) +
                 " bytes to port " + std::to_string(max->first.first) + ")",
             text);
}

}  // namespace hagen::sensors
