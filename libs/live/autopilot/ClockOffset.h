#pragma once
#include <limits>
#include <optional>

namespace hagen::live {

/// Estimates the offset of the vehicle's clock from message arrival times. The minimum delay is
/// assumed to be zero, and may grow at most at the maximum clock drift. Messages delayed by a radio
/// link or a busy reader therefore keep their true age, even over many seconds.
///
/// A larger offset is accepted if the vehicle restarted: its clock then shows less time than has
/// passed since the last message on time. A simulated vehicle's clock may also pause or run slow.
class ClockOffset {
 public:
    explicit ClockOffset(bool is_simulated = false) : is_simulated_(is_simulated) {}

    struct Result {
        double time_s;       ///< on the local clock
        bool has_restarted;  ///< the vehicle's clock jumped or restarted: earlier times are invalid
    };
    /// The local time at which a message was stamped; never after its arrival.
    Result ourTime(double stamp_s, double arrival_s);

 private:
    /// A larger offset on which all messages since `since_s` agree.
    struct Other {
        double since_s, low_s, high_s;
        bool went_back;
    };
    bool isOther(double stamp_s, double arrival_s);

    bool is_simulated_;
    std::optional<double> offset_s_;
    double last_arrival_s_ = 0,
           in_time_s_ = 0;  ///< arrival of the last message, and of the last message on time
    double latest_stamp_s_ = -std::numeric_limits<double>::infinity();
    std::optional<Other> other_;
    int ahead_ = 0;  ///< consecutive messages with a much smaller offset
};

}  // namespace hagen::live
