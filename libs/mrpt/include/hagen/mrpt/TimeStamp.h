#pragma once
#include <mrpt/core/Clock.h>

namespace hagen::observations {

/// Plausible times: from 1601, the start of MRPT's clock, to the year 5138. Differences of other
/// times overflow in MRPT.
constexpr double kEarliest_s = -11644473600.0, kLatest_s = 1e11;

/// secondsOf(INVALID_TIMESTAMP), which means "no time" in files.
constexpr double kNoTime_s = kEarliest_s;

/// Whether a number of seconds since 1970 is a plausible time; false for NaN.
inline bool isTime(double since_1970_s) {
    return since_1970_s > kEarliest_s && since_1970_s < kLatest_s;
}

/// Seconds since 1970, even for implausible time stamps.
inline double secondsOf(mrpt::Clock::time_point time) {
    const double ticks_s = 1e-7 * static_cast<double>(time.time_since_epoch().count());
    const double since_1970_s = ticks_s + kEarliest_s;
    // MRPT's function is exact to the tick.
    return isTime(since_1970_s) ? mrpt::Clock::toDouble(time) : since_1970_s;
}

/// Whether a time stamp is a plausible time. False for INVALID_TIMESTAMP.
inline bool isTime(mrpt::Clock::time_point time) { return isTime(secondsOf(time)); }

}  // namespace hagen::observations
