#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hagen::live {

constexpr double kSilence_s = 1.0;  // is reported; then another address can be the sensor's

/// Which of the addresses that send packets of the sensor's model is the sensor's: the first one,
/// or another that starts to send while this one is silent.
class SensorAddress {
 public:
    /// Whether a packet from this address belongs to the sensor. Unsound packets count as well.
    bool take(std::uint32_t ip, double arrival_s);
    /// None before the first packet.
    std::optional<std::uint32_t> ip() const {
        return own_.empty() ? std::nullopt : std::optional(own_[current_]);
    }

 private:
    bool choose(std::uint32_t ip, bool is_silent);

    static constexpr std::size_t kMaxAddresses = 64;

    /// The sensor's addresses so far, in their order: it may return to an earlier one.
    std::vector<std::uint32_t> own_;
    std::size_t current_ = 0;  ///< of these
    double heard_s_ = 0;       ///< the latest packet from that one
    /// Those that sent while the sensor did: of other sensors, for good.
    std::vector<std::uint32_t> others_;
};

}  // namespace hagen::live
