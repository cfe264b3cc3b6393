#pragma once
#include <hagen/avoidance/Planner.h>

namespace hagen::avoidance {

/// "primitives": the cheapest free one of a fixed set of motions.
class MotionPrimitives : public Planner {
 public:
    Plan plan(const WorldModel& world, const PlanningTask& task) const override;
};

}  // namespace hagen::avoidance
