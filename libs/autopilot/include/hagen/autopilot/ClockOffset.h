#pragma once
#include <limits>
#include <optional>

namespace hagen::autopilot {

/// How far the clock of a vehicle is behind ours, by when its messages come: each comes some time
/// after it was stamped, the fastest ones soonest. The shortest delay is taken for none, and grows
/// by no more than clocks drift. So messages that waited, on a radio link or since nobody read, are
/// as old as they are, also by seconds and for as long as it lasts.
///
/// A larger offset is believed if the vehicle's clock began anew, or stood still: see kAnew and
/// kStill.
class ClockOffset {
 public:
    struct Result {
        double time_s;       ///< of our clock
        bool has_restarted;  ///< the vehicle's clock jumped or began anew: older times are void
    };
    /// What our clock showed when a message was stamped; never after its arrival.
    Result ourTime(double stamp_s, double arrival_s);

 private:
    /// A larger offset, on which all messages since some time agree.
    struct Other {
        double since_s, low_s, high_s;
        bool is_anew;
    };
    bool isOther(double stamp_s, double arrival_s);

    std::optional<double> offset_s_;
    double last_stamp_s_ = 0, last_arrival_s_ = 0;
    double latest_stamp_s_ = -std::numeric_limits<double>::infinity();
    std::optional<Other> other_;
};

}  // namespace hagen::autopilot
