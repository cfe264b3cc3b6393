#pragma once
#include <limits>

namespace hagen::autopilot {

/// How far the clock of a vehicle is behind ours, by when its messages come: each comes some time
/// after it was stamped, the fastest ones soonest. The shortest delay of the last 5 to 10 s is
/// taken for none. Messages that come late are so old, also by seconds; only if all of 5 to 10 s
/// do has the vehicle's clock stood still meanwhile.
class ClockOffset {
 public:
    struct Result {
        double time_s;       ///< of our clock
        bool has_restarted;  ///< the vehicle's clock jumped or began anew: older times are void
    };
    /// What our clock showed when a message was stamped; never after its arrival.
    Result ourTime(double stamp_s, double arrival_s);

 private:
    static constexpr double kNone = std::numeric_limits<double>::infinity();
    double window_start_s_ = -kNone;
    double least_s_ = kNone, least_before_s_ = kNone;  ///< of arrival - stamp, per window
    double latest_stamp_s_ = -kNone;
};

}  // namespace hagen::autopilot
