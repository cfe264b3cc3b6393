#include <hagen/avoidance/CommandQueue.h>
#include <algorithm>

namespace hagen::avoidance {

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

avoidance::VehicleState CommandQueue::advanced(avoidance::VehicleState state, double from_s,
                                               double to_s,
                                               const avoidance::VehicleLimits& limits) const {
    constexpr double kLeast_s = 1e-9;
    double now_s = from_s;
    while (to_s - now_s > kLeast_s) {
        double next_s = std::min(to_s, now_s + avoidance::kControlStep_s);
        for (const Command& command : commands_) {
            if (command.from_s > now_s + kLeast_s) next_s = std::min(next_s, command.from_s);
        }
        state = avoidance::advance(state, at(now_s + kLeast_s), next_s - now_s, limits);
        now_s = next_s;
    }
    return state;
}

void CommandQueue::forgetBefore(double time_s) {
    while (commands_.size() > 1 && commands_[1].from_s <= time_s) commands_.pop_front();
}

}  // namespace hagen::avoidance
