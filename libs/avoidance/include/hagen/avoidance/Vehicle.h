#pragma once
#include <Eigen/Core>
#include <deque>

namespace hagen::avoidance {

/// Dynamics and size of a multirotor.
struct VehicleLimits {
    double acceleration_m_s2 = 5;
    double actuation_delay_s = 0.05;  ///< until a command takes effect
    double radius_m = 0.45;
    double margin_m = 0.2;      ///< added to the radius by planners
    double collision_m = 0.30;  ///< a true clearance below this is a collision
    double response_per_s = 5;  ///< gain: acceleration per velocity error

    double clearance_radius_m() const { return radius_m + margin_m; }
};

struct VehicleState {
    Eigen::Vector3d position_m{0, 0, 0};
    Eigen::Vector3d velocity_m_s{0, 0, 0};
};

constexpr double kControlStep_s = 0.02;  ///< 50 Hz

/// The acceleration towards a commanded velocity, within the limits.
Eigen::Vector3d accelerationFor(const VehicleState& state, const Eigen::Vector3d& command_m_s,
                                const VehicleLimits& limits);

/// One step of a double integrator that follows a commanded velocity.
VehicleState advance(const VehicleState& state, const Eigen::Vector3d& command_m_s, double step_s,
                     const VehicleLimits& limits);

/// Velocity commands, each with its start time.
class CommandQueue {
 public:
    /// Times must not decrease.
    void add(double followed_from_s, const Eigen::Vector3d& command_m_s);

    /// The command in effect at a time; zero before the first command.
    Eigen::Vector3d at(double time_s) const;

    /// The state at `to_s` given `state` at `from_s`. Integrates in steps of at most
    /// kControlStep_s; a step ends where a new command starts.
    VehicleState advanced(VehicleState state, double from_s, double to_s,
                          const VehicleLimits& limits) const;

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
