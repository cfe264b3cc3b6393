#pragma once
#include <limits>
#include <optional>

namespace hagen::live {

/// How far the clock of a vehicle is behind ours, by when its messages come: each comes some time
/// after it was stamped, the fastest ones soonest. The shortest delay is taken for none, and grows
/// by no more than clocks drift. So messages that waited, on a radio link or since nobody read, are
/// as old as they are, also by seconds and for as long as it lasts.
///
/// A larger offset is believed if the vehicle started again: its clock is younger then than what
/// passed since the last message that was in time. That of a simulated vehicle may pause and be
/// slow, too.
class ClockOffset {
 public:
    explicit ClockOffset(bool is_simulated = false) : is_simulated_(is_simulated) {}

    struct Result {
        double time_s;       ///< of our clock
        bool has_restarted;  ///< the vehicle's clock jumped or began anew: older times are void
    };
    /// The local time at which a message was stamped; never after its arrival.
    Result ourTime(double stamp_s, double arrival_s);

 private:
    /// A larger offset, on which all messages since some time agree.
    struct Other {
        double since_s, low_s, high_s;
        bool went_back;
    };
    bool isOther(double stamp_s, double arrival_s);

    bool is_simulated_;
    std::optional<double> offset_s_;
    double last_arrival_s_ = 0, in_time_s_ = 0;  ///< arrivals: of any message, of one in time
    double latest_stamp_s_ = -std::numeric_limits<double>::infinity();
    std::optional<Other> other_;
    int ahead_ = 0;  ///< messages in a row with a much smaller offset
};

}  // namespace hagen::live
