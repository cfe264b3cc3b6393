#pragma once
#include <hagen/sensors/Datagram.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace hagen::live {

constexpr double kSilence_s = 1.0;  // a longer silence is reported, and a new address accepted

/// Selects the sensor's address among all that send packets of its model: the first address, or
/// another that starts sending while the selected one is silent. If given, only `ip`.
class SensorAddress {
 public:
    explicit SensorAddress(std::optional<sensors::IpAddress> ip = {}) : is_fixed_(ip.has_value()) {
        if (ip) own_.push_back(*ip);
    }
    /// Whether a packet from this address belongs to the sensor. Counts invalid packets, too.
    bool take(sensors::IpAddress ip, double arrival_s);
    /// The current address; nullopt before the first packet.
    std::optional<sensors::IpAddress> ip() const {
        return own_.empty() ? std::nullopt : std::optional(own_[current_]);
    }
    /// Addresses that sent at the same time as the sensor and therefore belong to other sensors.
    const std::vector<sensors::IpAddress>& others() const { return others_; }

 private:
    bool choose(sensors::IpAddress ip, bool is_silent);

    static constexpr std::size_t kMaxAddresses = 64;

    const bool is_fixed_;
    /// Addresses of the sensor in order of appearance; it may return to an earlier address.
    std::vector<sensors::IpAddress> own_;
    std::size_t current_ = 0;  ///< index into `own_`
    double heard_s_ = 0;       ///< time of the latest packet from the current address
    std::vector<sensors::IpAddress> others_;
};

}  // namespace hagen::live
