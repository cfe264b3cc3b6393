#include "sensors/captures/Remarks.h"

#include <algorithm>
#include <initializer_list>

namespace hagen::sensors {
namespace {

bool startsWith(const Datagram& datagram, std::initializer_list<std::uint8_t> start) {
    return datagram.size >= start.size() && std::equal(start.begin(), start.end(), datagram.bytes);
}

struct UnsupportedVendor {
    const char* name;
    bool (*isData)(const Datagram& datagram);
};

/// Sensors whose packets are recognised, but not read.
const UnsupportedVendor kUnsupportedVendors[] = {
    {"a RoboSense",
     [](const Datagram& d) {
         return startsWith(d, {0x55, 0xaa, 0x05, 0x0a, 0x5a, 0xa5, 0x50, 0xa0}) ||
                startsWith(d, {0x55, 0xaa, 0x05, 0x5a}) ||
                startsWith(d, {0xaa, 0x55, 0x05, 0x5a}) || startsWith(d, {0x55, 0xaa, 0x5a, 0xa5});
     }},
    {"a Livox with SDK 1",
     [](const Datagram& d) {  // 18 bytes of header, then 100, 96 or 48 points; byte 9 is their type
         constexpr std::size_t kSizes[] = {1318, 918, 1362, 978, 1362, 786};
         return d.size > 9 && d.bytes[0] == 5 && d.bytes[9] < 6 && d.size == kSizes[d.bytes[9]];
     }},
    {"a Leishen", [](const Datagram& d) {  // 6 bytes longer than a Velodyne packet
         return d.size == 1212 && startsWith(d, {0xff, 0xee}) &&
                std::equal(d.bytes, d.bytes + 2, d.bytes + 100);
     }}};

}  // namespace

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
    for (const UnsupportedVendor& vendor : kUnsupportedVendors) {
        if (!vendor.isData(datagram)) continue;
        ++vendors_[vendor.name];
        return;
    }
    ++all_;
    const std::pair kind{datagram.to_port, datagram.size};
    if (kinds_.size() < kMaxKinds || kinds_.count(kind) > 0) ++kinds_[kind];
}

void OtherDatagrams::describe(std::string& text) const {
    for (const auto& [name, count] : vendors_) {
        addCount(count, "packet", "from " + name + " (not supported)", text);
    }
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
