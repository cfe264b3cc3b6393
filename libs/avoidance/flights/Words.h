#pragma once
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace hagen::avoidance {

// Words of runs.csv, in the order of Outcome, PoseError, brakes_in_known_space, Air and Updates.
constexpr std::array<const char*, 3> kOutcomes{"success", "collision", "timeout"};
constexpr std::array<const char*, 3> kPoseErrors{"none", "noise", "drift"};
constexpr std::array<const char*, 2> kUnknowns{"optimistic", "brake_known"};
constexpr std::array<const char*, 2> kAirs{"dusty", "clear"};
constexpr std::array<const char*, 2> kUpdates{"scans", "sectors"};

/// The value of a word; words stand in the order of the values. Throws std::runtime_error, naming
/// the known words, for any other.
template <class Value, std::size_t count>
Value wordFrom(const std::string& text, const std::array<const char*, count>& words) {
    std::string known;
    for (std::size_t w = 0; w < count; ++w) {
        if (text == words[w]) return static_cast<Value>(w);
        known += std::string(w > 0 ? ", " : "") + words[w];
    }
    throw std::runtime_error("\"" + text + "\" is not one of " + known);
}

}  // namespace hagen::avoidance
