#pragma once
#include <cmath>
#include <stdexcept>

namespace hagen::live {

constexpr double kMaxTime_s = 1e11;  // still exact to 0.02 ms

/// Throws std::invalid_argument unless this is a plausible arrival time.
inline void checkTime(double time_s) {
    if (!(std::abs(time_s) <= kMaxTime_s)) {
        throw std::invalid_argument("streaming: packet time missing or beyond 3000 years");
    }
}

}  // namespace hagen::live
