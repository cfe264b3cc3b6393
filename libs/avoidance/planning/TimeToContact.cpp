#include <hagen/avoidance/Planner.h>
#include "avoidance/planning/Motion.h"

namespace hagen::avoidance {

bool mustStop(const WorldModel& world, const PlanningTask& task) {
    std::vector<Eigen::Vector3f> path_m;
    rollOut(task.start, task.start.velocity_m_s, task.period_s, task.limits, path_m);
    return !freeClearance(world, path_m, task.start_after_s, task.limits.radius_m);
}

}  // namespace hagen::avoidance
