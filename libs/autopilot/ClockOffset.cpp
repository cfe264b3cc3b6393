#include <hagen/autopilot/ClockOffset.h>

#include <algorithm>
#include <cmath>

namespace hagen::autopilot {
namespace {

constexpr double kWindow_s = 5;
// No clock drifts that far.
constexpr double kJump_s = 1;

}  // namespace

ClockOffset::Result ClockOffset::ourTime(double stamp_s, double arrival_s) {
    const double offset_s = arrival_s - stamp_s;
    const auto known_s = [&] { return std::min(least_s_, least_before_s_); };
    const double before_s = known_s();
    const bool has_begun_anew = stamp_s < latest_stamp_s_ - kJump_s;
    const bool is_set_forward = offset_s < before_s - kJump_s;
    // Stamps that go on, and come late, may have waited: on a radio link, or because nobody read.
    if (before_s != kNone && (has_begun_anew || is_set_forward)) {
        least_s_ = least_before_s_ = kNone;
        latest_stamp_s_ = -kNone;
        window_start_s_ = arrival_s;
    } else if (arrival_s - window_start_s_ > kWindow_s) {
        // After a silence, what was known before it: the first messages may be those that waited.
        const bool was_silent = arrival_s - window_start_s_ > 2 * kWindow_s;
        least_before_s_ = was_silent ? before_s : least_s_;
        least_s_ = kNone;
        window_start_s_ = arrival_s;
    }
    least_s_ = std::min(least_s_, offset_s);
    latest_stamp_s_ = std::max(latest_stamp_s_, stamp_s);
    const bool has_restarted = before_s != kNone && std::abs(known_s() - before_s) > kJump_s;
    return {stamp_s + known_s(), has_restarted};
}

}  // namespace hagen::autopilot
