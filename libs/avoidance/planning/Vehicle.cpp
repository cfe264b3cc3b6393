#include <hagen/avoidance/Vehicle.h>
#include <algorithm>

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

void CommandQueue::add(double followed_from_s, const Eigen::Vector3d& command_m_s) {
    commands_.push_back({followed_from_s, command_m_s});
}

Eigen::Vector3d CommandQueue::at(double time_s) const {
    Eigen::Vector3d followed = Eigen::Vector3d::Zero();
    for (const Command& command : commands_) {
        if (command.from_s <= time_s) followed = command.velocity_m_s;
    }
    return followed;
}

VehicleState CommandQueue::advanced(VehicleState state, double from_s, double to_s,
                                    const VehicleLimits& limits) const {
    constexpr double kMin_s = 1e-9;
    double now_s = from_s;
    while (to_s - now_s > kMin_s) {
        double next_s = std::min(to_s, now_s + kControlStep_s);
        for (const Command& command : commands_) {
            if (command.from_s > now_s + kMin_s) next_s = std::min(next_s, command.from_s);
        }
        state = advance(state, at(now_s + kMin_s), next_s - now_s, limits);
        now_s = next_s;
    }
    return state;
}

void CommandQueue::forgetBefore(double time_s) {
    while (commands_.size() > 1 && commands_[1].from_s <= time_s) commands_.pop_front();
}

}  // namespace hagen::avoidance
