#include "live/autopilot/ClockOffset.h"

#include <algorithm>

namespace hagen::live {
namespace {

constexpr double kDrift = 1e-3;  // no clock drifts faster
constexpr double kSlow = 0.5;    // that of a simulation may be half as fast
constexpr double kJump_s = 1;    // no clock drifts that far
// A stamp that is corrupt, or of another vehicle, may be ahead; several in a row are right.
constexpr double kAhead_s = 0.1;
constexpr int kInARow = 3;

/// When a larger offset is believed: once all messages of some time agree on it. Those that waited
/// do not, since a link that is free again delivers them faster than they were sent.
struct Patience {
    double time_s, spread_s;
};
constexpr Patience kWentBack{0.5, 0.3};
// Stamps that are later than those before may have waited.
constexpr Patience kAfterGap{10, 0.2};

}  // namespace

/// Of a message that is late by more than a jump: whether it is not, because the clock is another.
bool ClockOffset::isOther(double stamp_s, double arrival_s) {
    const double offset_s = arrival_s - stamp_s;
    // A clock that went on is older: its messages came by a longer way.
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
