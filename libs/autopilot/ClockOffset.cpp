#include <hagen/autopilot/ClockOffset.h>

#include <algorithm>
#include <cmath>

namespace hagen::autopilot {
namespace {

constexpr double kDrift = 1e-3;  // no clock drifts faster
constexpr double kJump_s = 1;    // nor that far
constexpr double kPaused_s = 0.5;

/// When a larger offset is believed: once all messages of some time agree on it. Those that waited
/// do not, since a link that is free again delivers them faster than they were sent.
struct Patience {
    double time_s, spread_s;
};
// Stamps went back. A single one may have come by a longer way.
constexpr Patience kAnew{0.5, 0.3};
// Nothing came for as long as the offset grew, and stamps go on where they were: a simulation that
// paused.
constexpr Patience kStill{10, 0.2};

}  // namespace

/// Of a message that is late by more than a jump: whether it is not, because the clock is another.
bool ClockOffset::isOther(double stamp_s, double arrival_s) {
    const double offset_s = arrival_s - stamp_s;
    const bool is_anew = stamp_s < latest_stamp_s_ - kJump_s;
    const bool is_still = !is_anew && arrival_s - last_arrival_s_ > kJump_s &&
                          std::abs(stamp_s - last_stamp_s_) < kPaused_s;
    const bool goes_on = other_ && other_->is_anew == is_anew && !is_still;
    if (goes_on) {
        other_->low_s = std::min(other_->low_s, offset_s);
        other_->high_s = std::max(other_->high_s, offset_s);
    }
    const Patience& patience = is_anew ? kAnew : kStill;
    if (goes_on && other_->high_s - other_->low_s <= patience.spread_s) {
        return arrival_s - other_->since_s >= patience.time_s;
    }
    other_.reset();
    if (is_anew || is_still) other_ = Other{arrival_s, offset_s, offset_s, is_anew};
    return false;
}

ClockOffset::Result ClockOffset::ourTime(double stamp_s, double arrival_s) {
    const double offset_s = arrival_s - stamp_s;
    const bool is_first = !offset_s_;
    bool has_restarted = false;
    if (!is_first) {
        *offset_s_ += kDrift * std::max(arrival_s - last_arrival_s_, 0.0);
        const bool is_late = offset_s > *offset_s_ + kJump_s;
        const bool is_other = is_late && isOther(stamp_s, arrival_s);
        if (!is_late || is_other) other_.reset();
        has_restarted = is_other || offset_s < *offset_s_ - kJump_s;
    }
    if (is_first || has_restarted) {
        offset_s_ = offset_s;
        latest_stamp_s_ = stamp_s;
    }
    offset_s_ = std::min(*offset_s_, offset_s);
    latest_stamp_s_ = std::max(latest_stamp_s_, stamp_s);
    last_stamp_s_ = stamp_s;
    last_arrival_s_ = arrival_s;
    return {std::min(stamp_s + *offset_s_, arrival_s), has_restarted};
}

}  // namespace hagen::autopilot
