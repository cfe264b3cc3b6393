#include <hagen/avoidance/Vehicle.h>

namespace hagen::avoidance {

Eigen::Vector3d accelerationFor(const VehicleState& state, const Eigen::Vector3d& command_m_s,
                                const VehicleLimits& limits) {
    const Eigen::Vector3d wanted = limits.response_per_s * (command_m_s - state.velocity_m_s);
    const double size = wanted.norm();
    return size > limits.acceleration_m_s2 ? wanted * (limits.acceleration_m_s2 / size) : wanted;
}

VehicleState advance(const VehicleState& state, const Eigen::Vector3d& command_m_s, double step_s,
                     const VehicleLimits& limits) {
    const Eigen::Vector3d acceleration = accelerationFor(state, command_m_s, limits);
    return {state.position_m + step_s * state.velocity_m_s + 0.5 * step_s * step_s * acceleration,
            state.velocity_m_s + step_s * acceleration};
}

}  // namespace hagen::avoidance
