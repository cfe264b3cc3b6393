#pragma once
#include <hagen/avoidance/Planner.h>

namespace hagen::avoidance {

/// "3dvfh": the cheapest direction of a polar histogram, after 3DVFH+ (Vanneste, Bellekens and
/// Weyn, 2014). A cell holds how far a ball of the vehicle's room can go its way.
class PolarHistogram : public Planner {
 public:
    Plan plan(const WorldModel& world, const PlanningTask& task) const override;
};

}  // namespace hagen::avoidance
