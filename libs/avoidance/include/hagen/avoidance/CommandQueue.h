#pragma once
#include <hagen/avoidance/Vehicle.h>
#include <deque>

namespace hagen::avoidance {

/// Velocity commands, each with the time from which the vehicle follows it.
class CommandQueue {
 public:
    /// Times must not decrease.
    void add(double followed_from_s, const Eigen::Vector3d& command_m_s);

    /// The command followed at a time; zero before the first.
    Eigen::Vector3d at(double time_s) const;

    /// The state at `to_s` of a vehicle that is in `state` at `from_s`. Integrates in steps of at
    /// most kControlStep_s; a step ends where a new command begins.
    avoidance::VehicleState advanced(avoidance::VehicleState state, double from_s, double to_s,
                                     const avoidance::VehicleLimits& limits) const;

    /// Drops commands that ended before a time.
    void forgetBefore(double time_s);

 private:
    struct Command {
        double from_s;
        Eigen::Vector3d velocity_m_s;
    };
    std::deque<Command> commands_;
};

}  // namespace hagen::avoidance
