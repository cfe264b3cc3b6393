#pragma once
#include <hagen/avoidance/Planner.h>

namespace hagen::avoidance {

/// "primitives": chooses the cheapest free motion of a fixed set.
class MotionPrimitives : public Planner {
 public:
    Plan plan(const WorldModel& world, const PlanningTask& task) const override;
};

/// "3dvfh": chooses the cheapest direction of a polar histogram, after 3DVFH+ (Vanneste, Bellekens
/// and Weyn, 2014). A cell stores the free distance of a sphere of the clearance radius.
class PolarHistogram : public Planner {
 public:
    Plan plan(const WorldModel& world, const PlanningTask& task) const override;
};

}  // namespace hagen::avoidance
