#include <hagen/avoidance/WindowSize.h>
#include <hagen/avoidance/WorldModel.h>
#include <cmath>

#include "avoidance/planning/Motion.h"

namespace hagen::avoidance {
namespace {

constexpr double kMinRadius_m = 15, kMaxRadius_m = 50;
constexpr float kMinPerceptionRange_m = 20;

}  // namespace

WindowSize windowSizeFor(const FlightPace& pace) {
    constexpr double kRounding = 1e-9;
    const double remembered_s = pace.reaction_s() + pace.stopping_s();
    const double touched_m = pace.speed_m_s * (pace.reaction_s() + kLookAhead_s) +
                             pace.stopping_m() + static_cast<double>(WorldModel::kReach_m);
    return {static_cast<std::size_t>(std::ceil(remembered_s / pace.scan_period_s - kRounding)),
            static_cast<float>(std::clamp(touched_m, kMinRadius_m, kMaxRadius_m))};
}

float perceptionRangeFor_m(const FlightPace& pace) {
    return std::max(kMinPerceptionRange_m, windowSizeFor(pace).radius_m);
}

}  // namespace hagen::avoidance
