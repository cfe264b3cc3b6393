#pragma once
#include <hagen/sensors/Datagram.h>
#include "base/NumberText.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace hagen::sensors {

using base::counted;

/// Appends ", 3 packets MORE" unless the number is 0.
void addCount(std::size_t number, const std::string& one, const std::string& more,
              std::string& text);

/// Joins two lists by ", "; either may be empty.
std::string joined(const std::string& first, const std::string& second);

/// Counts datagrams that no driver accepts, by vendor or by port and size.
class OtherDatagrams {
 public:
    void add(const Datagram& datagram);
    /// Appends ", 5 other UDP datagrams (most: 3 of 48 bytes to port 7503)" unless there are none.
    void describe(std::string& text) const;
    /// True if some are from a vendor that is not supported.
    bool haveVendor() const { return !vendors_.empty(); }

 private:
    std::size_t all_ = 0;  ///< from unknown vendors
    std::map<std::string, std::size_t> vendors_;
    std::map<std::pair<std::uint16_t, std::size_t>, std::size_t> kinds_;
};

}  // namespace hagen::sensors
