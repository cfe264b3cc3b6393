#include "live/autopilot/ClockOffset.h"

#include <algorithm>

namespace hagen::live {
namespace {

constexpr double kDrift = 1e-3;  // maximum drift of a clock
constexpr double kSlow = 0.5;    // minimum speed of a simulated clock
constexpr double kJump_s = 1;    // minimum change that is a restart, not drift
// A single time stamp this far ahead may be corrupt or from another vehicle; kInARow consecutive
// time stamps are valid.
constexpr double kAhead_s = 0.1;
constexpr int kInARow = 3;

/// A larger offset is accepted once all messages for `time_s` agree on it within `spread_s`.
/// Delayed messages do not agree, because a recovered link delivers them faster than they were
/// sent.
struct Patience {
    double time_s, spread_s;
};
constexpr Patience kWentBack{0.5, 0.3};
// Longer, because messages with increasing time stamps may be delayed ones.
constexpr Patience kAfterGap{10, 0.2};

}  // namespace

/// Whether a message that is more than kJump_s late is on time because the clock has restarted.
bool ClockOffset::isOther(double stamp_s, double arrival_s) {
    const double offset_s = arrival_s - stamp_s;
    // If the clock did not restart, its time stamp is later and the message is delayed.
    const bool may_be_anew = is_simulated_ || stamp_s < arrival_s - in_time_s_ + kJump_s;
    const bool went_back = may_be_anew && stamp_s < latest_stamp_s_ - kJump_s;
    const bool begins =
        may_be_anew && (went_back || arrival_s - last_arrival_s_ > kJump_s) &&
        (!other_ || other_->went_back != went_back || arrival_s - last_arrival_s_ > kJump_s);
    const bool goes_on = other_ && !begins && other_->went_back == went_back;
    if (goes_on) {
        other_->low_s = std::min(other_->low_s, offset_s);
        other_->high_s = std::max(other_->high_s, offset_s);
    }
    const Patience& patience = went_back ? kWentBack : kAfterGap;
    if (goes_on && other_->high_s - other_->low_s <= patience.spread_s) {
        return arrival_s - other_->since_s >= patience.time_s;
    }
    other_.reset();
    if (begins || went_back) other_ = Other{arrival_s, offset_s, offset_s, went_back};
    return false;
}

ClockOffset::Result ClockOffset::ourTime(double stamp_s, double arrival_s) {
    const double offset_s = arrival_s - stamp_s;
    const bool is_first = !offset_s_;
    bool is_late = false, has_restarted = false;
    if (!is_first) {
        const double passed_s = std::max(arrival_s - last_arrival_s_, 0.0);
        *offset_s_ += (is_simulated_ ? kSlow : kDrift) * passed_s;
        if (offset_s >= *offset_s_ - kAhead_s) {
            ahead_ = 0;
        } else if (++ahead_ < kInARow) {
            last_arrival_s_ = arrival_s;
            return {arrival_s, false};
        }
        is_late = offset_s > *offset_s_ + kJump_s;
        has_restarted = offset_s < *offset_s_ - kJump_s;
        if (is_late && isOther(stamp_s, arrival_s)) {
            is_late = false;
            has_restarted = true;
        }
    }
    if (!is_late) {
        other_.reset();
        in_time_s_ = arrival_s;
    }
    if (is_first || has_restarted) {
        offset_s_ = offset_s;
        latest_stamp_s_ = stamp_s;
    }
    offset_s_ = std::min(*offset_s_, offset_s);
    latest_stamp_s_ = std::max(latest_stamp_s_, stamp_s);
    last_arrival_s_ = arrival_s;
    return {std::min(stamp_s + *offset_s_, arrival_s), has_restarted};
}

}  // namespace hagen::live
