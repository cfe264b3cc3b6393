#pragma once
#include <hagen/avoidance/Planner.h>

namespace hagen::avoidance {

/// "primitives": chooses the cheapest free motion of a fixed set.
class MotionPrimitives : public Planner {
 public:
    Plan plan(const WorldModel& world, const PlanningTask& task) const override;
};

}  // namespace hagen::avoidance
