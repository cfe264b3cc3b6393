#pragma once
#include <Eigen/Core>

namespace hagen::avoidance {

/// What a multirotor can do, and how much room it needs.
struct VehicleLimits {
    double acceleration_m_s2 = 5;
    double actuation_delay_s = 0.05;  ///< from a command to when it is followed
    double radius_m = 0.45;
    double margin_m = 0.2;      ///< that planners keep beyond the radius
    double collision_m = 0.30;  ///< a true clearance under this is a collision
    double response_per_s = 5;  ///< acceleration asked for, per difference of velocity

    double room_m() const { return radius_m + margin_m; }
};

struct VehicleState {
    Eigen::Vector3d position_m{0, 0, 0};
    Eigen::Vector3d velocity_m_s{0, 0, 0};
};

constexpr double kControlStep_s = 0.02;  ///< 50 Hz

/// The acceleration that a commanded velocity causes: towards it, at most what the limits allow.
Eigen::Vector3d accelerationFor(const VehicleState& state, const Eigen::Vector3d& command_m_s,
                                const VehicleLimits& limits);

/// A double integrator that follows a commanded velocity for a step.
VehicleState advance(const VehicleState& state, const Eigen::Vector3d& command_m_s, double step_s,
                     const VehicleLimits& limits);

}  // namespace hagen::avoidance
