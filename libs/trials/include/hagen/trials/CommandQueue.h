#pragma once
#include <hagen/avoidance/Vehicle.h>
#include <deque>

namespace hagen::trials {

/// Commands that were given, each from the time on when it is followed.
class CommandQueue {
 public:
    /// Times must not decrease.
    void add(double followed_from_s, const Eigen::Vector3d& command_m_s);

    /// The command followed at a time; to stand still before the first.
    Eigen::Vector3d at(double time_s) const;

    /// The state at `to_s`, of a vehicle that is in `state` at `from_s`: in steps of at most
    /// kControlStep_s, which end where a command begins.
    avoidance::VehicleState advanced(avoidance::VehicleState state, double from_s, double to_s,
                                     const avoidance::VehicleLimits& limits) const;

    /// Forgets commands that ended before a time.
    void forgetBefore(double time_s);

 private:
    struct Command {
        double from_s;
        Eigen::Vector3d velocity_m_s;
    };
    std::deque<Command> commands_;
};

}  // namespace hagen::trials
