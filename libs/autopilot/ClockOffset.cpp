#include <hagen/autopilot/ClockOffset.h>

#include <algorithm>

namespace hagen::autopilot {
namespace {

constexpr double kWindow_s = 5;
// No message is that late, and no clock drifts that far.
constexpr double kJump_s = 1;

}  // namespace

ClockOffset::Result ClockOffset::ourTime(double stamp_s, double arrival_s) {
    const double offset_s = arrival_s - stamp_s;
    const double known_s = std::min(least_s_, least_before_s_);
    const bool has_restarted =
        known_s != kNone && (offset_s > known_s + kJump_s || offset_s < known_s - kJump_s);
    if (has_restarted) least_s_ = least_before_s_ = kNone;
    if (arrival_s - window_start_s_ > kWindow_s || has_restarted) {
        least_before_s_ = least_s_;
        if (arrival_s - window_start_s_ > 2 * kWindow_s) least_before_s_ = kNone;
        least_s_ = kNone;
        window_start_s_ = arrival_s;
    }
    least_s_ = std::min(least_s_, offset_s);
    return {stamp_s + std::min(least_s_, least_before_s_), has_restarted};
}

}  // namespace hagen::autopilot
